#include "sim/study/slurm.h"

#include "sim/files/output_file.h"
#include "sim/input/command_words.h"
#include "sim/input/input_error.h"
#include "sim/input/standard_streams.h"

#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;
using input::shell_word;

bool is_program(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

void expect_sbatch() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (is_program(fs::path(folder) / "sbatch")) return;
  throw input::input_error("", 0, "--executor", "no sbatch on the PATH",
                           "Slurm's sbatch, or --executor local");
}

/// What a status of std::system means.
std::string in_words(int status) {
  if (status == -1) return "could not be started";
  if (WIFSIGNALED(status)) return fmt::format("was killed by signal {}", WTERMSIG(status));
  return fmt::format("ended with exit code {}", WEXITSTATUS(status));
}

} // namespace

void run_by_slurm(const std::string& line, std::size_t tasks, const fs::path& folder) {
  expect_sbatch();
  const std::string where = fs::absolute(folder).string();
  files::write_file(folder / "task.sh", "#!/bin/sh\n" + line + "\n");
  const std::string command = fmt::format(
      "sbatch --quiet --wait --array=0-{} --ntasks=1 --cpus-per-task=1 --job-name=hopmesh "
      "--chdir={} --output={} {} < /dev/null >&2",
      tasks - 1, shell_word(where), shell_word(where + "/task-%a.log"), shell_word(where + "/task.sh"));
  std::fflush(nullptr);
  const int status = std::system(command.c_str());
  if (status != 0)
    input::say(fmt::format("hopmesh: sbatch, or a task of its, {}; see task-*.log in {}\n", in_words(status),
                           where));
}

} // namespace hopmesh::study
