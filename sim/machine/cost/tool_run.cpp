#include "sim/machine/cost/tool_run.h"

#include <atomic>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace hopmesh::machine {

namespace {

namespace fs = std::filesystem;

constexpr const char* library = "/usr/share/qflow/tech/osu018/osu018_stdcells.lib";

std::string along_path(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    if (!folder.empty() && access(file.c_str(), X_OK) == 0) return file.string();
  }
  return "";
}

} // namespace

std::vector<std::string> CostTools::missing() const {
  std::vector<std::string> names;
  if (yosys.empty()) names.emplace_back("yosys");
  if (nextpnr.empty()) names.emplace_back("nextpnr-ice40");
  if (sta.empty()) names.emplace_back("opensta");
  if (liberty.empty()) names.emplace_back("qflow-tech-osu018");
  return names;
}

CostTools find_cost_tools() {
  CostTools tools{along_path("yosys"), along_path("nextpnr-ice40"), along_path("sta"), ""};
  if (access(library, R_OK) == 0) tools.liberty = library;
  return tools;
}

int run_tool(const std::vector<std::string>& words, const fs::path& folder, const std::string& log) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = -1;
  const bool begun = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (!begun || waitpid(child, &status, 0) != child) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string file_text(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void do_jobs(const std::vector<std::function<void()>>& jobs, std::size_t workers) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < jobs.size(); k = next++) jobs[k]();
  };
  std::vector<std::thread> threads;
  for (std::size_t k = 1; k < std::min(workers, jobs.size()); ++k) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
}

} // namespace hopmesh::machine
