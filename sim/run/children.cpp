#include "sim/run/children.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace hopmesh::run {

namespace {

/// An exception must not leave the child: it would unwind the parent's work there.
int exit_code_of(const std::function<int()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    fmt::print(stderr, "hopmesh: {}\n", error.what());
    return child_failed;
  }
}

} // namespace

std::string describe(const ChildEnd& end) {
  return end.signal ? fmt::format("killed by signal {} ({})", end.signal, strsignal(end.signal))
                    : fmt::format("ended with exit code {}", end.exit_code);
}

Child::Child(const std::function<int()>& work) {
  std::fflush(nullptr); // else both would write what waits
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("no child process can be made");
  if (pid_ > 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(child_failed); // the parent was killed before that line
  const int code = exit_code_of(work);
  std::fflush(nullptr);
  _exit(code);
}

Child::~Child() {
  if (end_) return;
  kill(pid_, SIGKILL);
  wait();
}

std::optional<ChildEnd> Child::ask(int options) {
  int status = 0;
  pid_t answer = -1;
  while (!end_ && (answer = waitpid(pid_, &status, options)) < 0 && errno == EINTR) {
  }
  if (answer == pid_)
    end_ = ChildEnd{WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0};
  return end_;
}

std::optional<ChildEnd> Child::ended() {
  return ask(WNOHANG);
}

ChildEnd Child::wait() {
  return ask(0).value_or(ChildEnd{child_failed, 0});
}

ChildEnd run_in_child(const std::function<int()>& work, unsigned seconds) {
  return Child([&] {
           std::signal(SIGALRM, SIG_DFL);
           alarm(seconds);
           try {
             return work();
           } catch (const std::exception&) {
             return child_failed;
           }
         })
      .wait();
}

bool run_in_children(const std::vector<std::size_t>& numbers, std::size_t workers,
                     const std::function<int(std::size_t)>& work,
                     const std::function<void(std::size_t, const ChildEnd&)>& ended,
                     const std::atomic<bool>& stop) {
  constexpr auto glance = std::chrono::milliseconds(2); // at children and at `stop`; no work is so short
  std::map<std::size_t, Child> children;
  std::size_t next = 0;
  while (!stop && (next < numbers.size() || !children.empty())) {
    for (; next < numbers.size() && children.size() < workers; ++next)
      children.try_emplace(numbers[next], [&] { return work(numbers[next]); });
    for (auto child = children.begin(); child != children.end();) {
      const std::optional<ChildEnd> end = child->second.ended();
      if (end) ended(child->first, *end);
      child = end ? children.erase(child) : std::next(child);
    }
    if (children.size() == workers || next == numbers.size()) std::this_thread::sleep_for(glance);
  }
  return !stop;
}

} // namespace hopmesh::run
