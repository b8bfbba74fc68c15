#include "sim/cosim/finding.h"

#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::cosim {

namespace {

constexpr unsigned trial_seconds = 60;
constexpr int crashed = 98, differ = 99;

} // namespace

int in_child(const std::function<int()>& work, unsigned seconds) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no child process can be made");
  if (child == 0) {
    std::signal(SIGALRM, SIG_DFL);
    alarm(seconds);
    int answer = crashed;
    try {
      answer = work();
    } catch (const std::exception&) { // as good as a crash: the parent is told
    }
    _exit(answer);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 100 + WTERMSIG(status);
}

bool differs_in_child(const Ways& ways, const ArrayJob& job) {
  return in_child([&] { return contest(ways, job).text.empty() ? 0 : differ; }, trial_seconds) != 0;
}

Ways involved(const Ways& ways, const Finding& finding) {
  if (finding.way == 0) return ways;
  return {ways[0], ways[finding.way]};
}

namespace {

void comment_answers(VectorWriter& file, const Way& way, const ArrayJob& job, levels::ArrayPort* array) {
  if (!array) return;
  const Answer a = ask(array->bus(), job, true);
  file.comment(fmt::format("{}: end {} {:d} {} {}", way.name, a.end.sweeps, a.end.converged,
                           a.end.largest_change, a.end.cycles));
  for (std::size_t k = 0; k < a.outputs.size(); ++k)
    file.comment(fmt::format("{}: after sweep {} {}", way.name, k + 1, fmt::join(a.outputs[k], " ")));
}

int write_whole(const std::filesystem::path& path, const VectorCase& a_case, const Ways& ways,
                const std::vector<std::string>& comments) {
  std::vector<std::unique_ptr<levels::ArrayPort>> arrays;
  for (const Way& way : ways) arrays.push_back(way.make(a_case.job.array, a_case.job.topology));
  VectorWriter file(path);
  for (const std::string& line : comments) file.comment(line);
  for (std::size_t k = 0; k < ways.size(); ++k) comment_answers(file, ways[k], a_case.job, arrays[k].get());
  file.add(a_case, &arrays[0]->bus());
  file.commit();
  return 0;
}

} // namespace

void write_finding(const std::filesystem::path& path, const VectorCase& a_case, const Ways& ways,
                   const std::vector<std::string>& comments) {
  files::check_writable(std::filesystem::absolute(path).parent_path(), 1 << 20);
  if (in_child([&] { return write_whole(path, a_case, ways, comments); }, trial_seconds) == 0) return;
  VectorWriter file(path); // whoever crashes, the case itself is kept
  for (const std::string& line : comments) file.comment(line);
  file.add(a_case, nullptr);
  file.commit();
}

} // namespace hopmesh::cosim
