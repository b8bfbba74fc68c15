// fork, pipes or a pseudo-terminal, exec, and listening to both streams until they close.
#include "tests/support/program.h"

#include "place.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <poll.h>
#include <pty.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::tests {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Two ends of a pipe, or of a pseudo-terminal.
struct Channel {
  int ours = -1, theirs = -1;

  explicit Channel(bool terminal) {
    int ends[2] = {-1, -1};
    const winsize size{24, 100, 0, 0};
    const int failed = terminal ? openpty(&ends[0], &ends[1], nullptr, nullptr, &size) : pipe(ends);
    if (failed) throw std::runtime_error("no channel to the program");
    ours = ends[0], theirs = ends[1];
  }
};

[[noreturn]] void become(const std::vector<std::string>& arguments, const Surroundings& s, const Channel& out,
                         const Channel& err) {
  dup2(out.theirs, STDOUT_FILENO);
  dup2(err.theirs, STDERR_FILENO);
  for (int fd : {out.ours, out.theirs, err.ours, err.theirs}) close(fd);
  for (const auto& [name, value] : s.environment) setenv(name.c_str(), value.c_str(), 1);
  if (s.largest_file > 0) {
    const rlimit limit{s.largest_file, s.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
    signal(SIGXFSZ, SIG_IGN); // the write fails, as on a full disk
  }
  const std::string program = s.program.empty() ? HOPMESH_PROGRAM : s.program;
  std::string name = std::filesystem::path(program).filename();
  std::vector<char*> argv{name.data()};
  for (const std::string& word : arguments) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  if (chdir(s.folder.c_str()) == 0) execv(program.c_str(), argv.data());
  _exit(127);
}

/// Adds what a stream holds; closes it at its end.
void take(int& fd, std::string& text) {
  char buffer[4096];
  const ssize_t count = read(fd, buffer, sizeof buffer);
  if (count > 0) {
    text.append(buffer, static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) { // a terminal without a child reads as an error
    close(fd);
    fd = -1;
  }
}

} // namespace

Program::Program(const std::vector<std::string>& arguments, const Surroundings& surroundings)
    : patience_ms_(1000 * surroundings.patience_seconds), began_(now()) {
  const Channel out(false), err(surroundings.terminal);
  child_ = fork();
  if (child_ == 0) become(arguments, surroundings, out, err);
  close(out.theirs);
  close(err.theirs);
  out_ = out.ours, err_ = err.ours;
}

Program::~Program() {
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  if (out_ >= 0) close(out_);
  if (err_ >= 0) close(err_);
}

bool Program::listen() {
  if (out_ < 0 && err_ < 0) return false;
  pollfd streams[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}}; // poll passes over -1
  const int ready = poll(streams, 2, patience_ms_);
  if (ready < 0 && errno == EINTR) return true;
  if (ready <= 0) return false;
  if (streams[0].revents) take(out_, result_.out);
  if (streams[1].revents) take(err_, result_.err);
  return true;
}

bool Program::wait_for(const std::string& text) {
  while (result_.err.find(text) == std::string::npos)
    if (!listen()) return false;
  return true;
}

void Program::send(int signal) const {
  kill(child_, signal);
}

Finished Program::finish() {
  while (listen()) {
  }
  if (out_ >= 0 || err_ >= 0) kill(child_, SIGKILL); // it went silent
  int status = 0;
  waitpid(child_, &status, 0);
  child_ = -1;
  result_.seconds = now() - began_;
  if (WIFEXITED(status)) result_.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result_.signal = WTERMSIG(status);
  return result_;
}

Finished run_program(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  return Program(arguments, surroundings).finish();
}

Finished run_shell(const std::string& line, Surroundings surroundings) {
  surroundings.program = "/bin/sh";
  surroundings.patience_seconds = 3600;
  return run_program({"-c", line}, surroundings);
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool quoted = false, begun = false;
  for (char c : line + ' ') {
    if (c == '\'') {
      quoted = !quoted, begun = true;
    } else if (c == ' ' && !quoted) {
      if (begun) words.push_back(word);
      word.clear(), begun = false;
    } else {
      word += c, begun = true;
    }
  }
  return words;
}

} // namespace hopmesh::tests
