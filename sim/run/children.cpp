#include "sim/run/children.h"

#include "sim/files/output_file.h"
#include "sim/input/input_error.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <new>
#include <set>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace hopmesh::run {

namespace {

/// What a child has to say goes to its parent, so that several of them do not say the same thing each.
struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0)
      throw std::system_error(errno, std::generic_category(), "no pipe to a child process can be made");
    read = ends[0], write = ends[1];
  }
};

/// Tells the parent why; a message that does not fit the pipe at once is cut.
int send(int to, const char* message, int exit_code) {
  const std::size_t bytes = std::min<std::size_t>(std::strlen(message), PIPE_BUF);
  if (::write(to, message, bytes) < 0) return exit_code; // the code says enough
  return exit_code;
}

/// An exception must not leave the child: it would unwind the parent's work there.
int exit_code_of(const std::function<int()>& work, int messages) {
  try {
    return work();
  } catch (const input::InputError& error) {
    return send(messages, error.what(), child_refused);
  } catch (const files::WriteError& error) {
    return send(messages, error.what(), child_refused);
  } catch (const std::bad_alloc&) {
    return send(messages, "memory: found less than a worker takes, expected fewer at a time (-j)",
                child_refused);
  } catch (const std::system_error& error) {
    return send(messages, error.what(), child_refused);
  } catch (const std::exception& error) {
    return send(messages, error.what(), child_failed);
  }
}

} // namespace

bool ChildEnd::from_outside() const {
  return signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP ||
         signal == SIGQUIT || signal == SIGXCPU;
}

std::string describe(const ChildEnd& end) {
  if (end.signal) return fmt::format("killed by signal {} ({})", end.signal, strsignal(end.signal));
  return fmt::format("ended with exit code {}{}{}", end.exit_code, end.message.empty() ? "" : ": ",
                     end.message);
}

Child::Child(const std::function<int()>& work) {
  std::fflush(nullptr); // else both would write what waits
  const Pipe pipe;
  const pid_t parent = getpid();
  pid_ = fork();
  const int reason = errno;
  if (pid_ != 0) {
    ::close(pipe.write);
    messages_ = pipe.read;
    if (pid_ > 0) return;
    ::close(messages_);
    throw std::system_error(reason, std::generic_category(), "no child process can be made");
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(child_failed); // the parent was killed before that line
  const int code = exit_code_of(work, pipe.write);
  std::fflush(nullptr);
  _exit(code);
}

Child::~Child() {
  if (!end_) {
    kill(pid_, SIGKILL);
    wait();
  }
  ::close(messages_);
}

// Asked once the child has ended.
std::string Child::message() {
  std::string text(PIPE_BUF, '\0');
  const ssize_t bytes = ::read(messages_, text.data(), text.size());
  text.resize(bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
  return text;
}

std::optional<ChildEnd> Child::ask(int options) {
  int status = 0;
  pid_t answer = -1;
  while (!end_ && (answer = waitpid(pid_, &status, options)) < 0 && errno == EINTR) {
  }
  if (answer == pid_)
    end_ = ChildEnd{WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                    message()};
  return end_;
}

std::optional<ChildEnd> Child::ended() {
  return ask(WNOHANG);
}

ChildEnd Child::wait() {
  return ask(0).value_or(ChildEnd{child_failed, 0, ""});
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

namespace {

/// Children at work, and the numbers that still wait for one.
class Pool {
 public:
  using Work = std::function<int(std::size_t)>;
  using Ended = std::function<void(std::size_t, const ChildEnd&)>;

  Pool(const std::vector<std::size_t>& numbers, std::size_t workers, const Work& work, const Ended& ended)
      : waiting_(numbers.begin(), numbers.end()), workers_(workers), work_(work), ended_(ended) {}

  bool busy() const { return !waiting_.empty() || !children_.empty(); }
  bool full() const { return children_.size() >= workers_ || waiting_.empty(); }

  void start() {
    for (; !full(); waiting_.pop_front()) {
      const std::size_t number = waiting_.front();
      try {
        children_.try_emplace(number, [&] { return work_(number); });
      } catch (const std::system_error&) {
        if (children_.empty()) throw;
        workers_ = children_.size(); // as many as the system lets us have
        return;
      }
    }
  }

  void look() {
    for (auto child = children_.begin(); child != children_.end();) {
      const std::optional<ChildEnd> end = child->second.ended();
      if (end) take(child->first, *end);
      child = end ? children_.erase(child) : std::next(child);
    }
  }

 private:
  void take(std::size_t number, const ChildEnd& end) {
    if (end.exit_code == child_refused) throw Refused(end.message);
    if (end.from_outside() && tried_again_.insert(number).second)
      waiting_.push_front(number);
    else
      ended_(number, end);
  }

  std::deque<std::size_t> waiting_;
  std::set<std::size_t> tried_again_;
  std::map<std::size_t, Child> children_;
  std::size_t workers_;
  const Work& work_;
  const Ended& ended_;
};

} // namespace

bool run_in_children(const std::vector<std::size_t>& numbers, std::size_t workers,
                     const std::function<int(std::size_t)>& work,
                     const std::function<void(std::size_t, const ChildEnd&)>& ended,
                     const std::atomic<bool>& stop) {
  constexpr auto glance = std::chrono::milliseconds(2); // at children and at `stop`; no work is so short
  Pool pool(numbers, workers, work, ended);
  while (!stop && pool.busy()) {
    pool.start();
    pool.look();
    if (pool.full()) std::this_thread::sleep_for(glance);
  }
  return !stop;
}

} // namespace hopmesh::run
