// Work in child processes: a crash takes one piece of work only, and SystemC, which elaborates once a
// process, can be made anew for each. A child is forked without exec, so it needs nothing read anew.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/types.h>
#include <vector>

namespace hopmesh::run {

/// Exit codes of a child: its work is done; the system refused it something (memory, a thread, room on the
/// disk) or a file it needs is wrong; an exception ended it; the user stopped it.
inline constexpr int child_done = 0, child_refused = 97, child_failed = 98, child_stopped = 130;

/// How a child ended. Neither: it left with exit code 0.
struct ChildEnd {
  int exit_code = 0, signal = 0;
  std::string message; ///< of the exception that ended it

  bool good() const { return exit_code == 0 && signal == 0; }
  /// Somebody ended it (the user, the system short of memory, an administrator): that says nothing about the
  /// work.
  bool from_outside() const;
};

/// "killed by signal 9 (Killed)", "ended with exit code 2", "ended with exit code 98: why".
std::string describe(const ChildEnd& end);

/// Why a child was refused what it needs, in a sentence.
class Refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A child at work, killed where its owner gives it up, and where its parent is killed.
class Child {
 public:
  /// The child leaves with the exit code that `work` returns. Throws std::system_error where the system makes
  /// no more processes.
  explicit Child(const std::function<int()>& work);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Empty while it is at work.
  std::optional<ChildEnd> ended();
  /// Waits for its end.
  ChildEnd wait();

 private:
  std::optional<ChildEnd> ask(int options);
  std::string message();

  pid_t pid_ = -1;
  int messages_ = -1; ///< to read from
  std::optional<ChildEnd> end_;
};

/// The end of one child, which is killed by SIGALRM after so many seconds.
ChildEnd run_in_child(const std::function<int()>& work, unsigned seconds);

/// Calls `work` for each number in a child, at most `workers` at a time, fewer where the system makes no more
/// processes; `ended` is called in this process. Work whose child was ended from outside is tried once more.
/// Throws Refused where the system refuses something to a child. False: `stop` was set, and children were
/// killed before their end.
bool run_in_children(const std::vector<std::size_t>& numbers, std::size_t workers,
                     const std::function<int(std::size_t)>& work,
                     const std::function<void(std::size_t, const ChildEnd&)>& ended,
                     const std::atomic<bool>& stop);

} // namespace hopmesh::run
