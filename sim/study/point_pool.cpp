// fork without exec: the child needs nothing read anew, and what it learns is in a file before it ends.
#include "sim/study/point_pool.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace hopmesh::study {

namespace {

constexpr auto glance = std::chrono::milliseconds(2); // at children and at `stop`; no point is so short

using Children = std::map<pid_t, std::size_t>;

pid_t begin(std::size_t number, const std::function<int(std::size_t)>& work) {
  std::fflush(nullptr);
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error("no process for a point");
  if (child > 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1); // it was killed before that line
  const int code = work(number);
  std::fflush(nullptr);
  _exit(code);
}

void take_ended(Children& children, const std::function<void(std::size_t, const ChildEnd&)>& ended) {
  for (auto child = children.begin(); child != children.end();) {
    int status = 0;
    if (waitpid(child->first, &status, WNOHANG) != child->first) {
      ++child;
      continue;
    }
    const std::size_t number = child->second;
    child = children.erase(child);
    ended(number, {WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0});
  }
}

void end_all(const Children& children) {
  for (const auto& child : children) kill(child.first, SIGKILL);
  for (const auto& child : children)
    while (waitpid(child.first, nullptr, 0) < 0 && errno == EINTR) {
    }
}

} // namespace

bool run_in_children(const std::vector<std::size_t>& numbers, std::size_t workers,
                     const std::function<int(std::size_t)>& work,
                     const std::function<void(std::size_t, const ChildEnd&)>& ended,
                     const std::atomic<bool>& stop) {
  Children children;
  std::size_t next = 0;
  while (!stop && (next < numbers.size() || !children.empty())) {
    for (; next < numbers.size() && children.size() < workers; ++next)
      children[begin(numbers[next], work)] = numbers[next];
    take_ended(children, ended);
    if (children.size() == workers || next == numbers.size()) std::this_thread::sleep_for(glance);
  }
  end_all(children);
  return !stop;
}

} // namespace hopmesh::study
