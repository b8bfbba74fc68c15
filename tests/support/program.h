// Runs the built program, or a command of the shell, as a child process: what it says, how it ends, how long
// it takes.
#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace hopmesh::tests {

/// How a child ended. Killed by a signal: exit_code is -1.
struct Finished {
  int exit_code = -1, signal = 0;
  std::string out, err;
  double seconds = 0;
};

/// The world a child lives in.
struct Surroundings {
  std::filesystem::path folder = "."; ///< where it stands
  std::vector<std::pair<std::string, std::string>> environment;
  bool terminal = false;        ///< stderr is a pseudo-terminal of 100 columns
  std::size_t largest_file = 0; ///< bytes a file may grow to (a write beyond fails); 0: no limit
  std::string program;          ///< empty: the built one
  int patience_seconds = 60;    ///< how long it may be silent
};

class Program {
 public:
  Program(const std::vector<std::string>& arguments, const Surroundings& surroundings);
  ~Program(); ///< kills what still runs
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Listens until stderr has shown the text; false when the program ended, or was silent for too long.
  bool wait_for(const std::string& text);
  void send(int signal) const;
  Finished finish();

 private:
  bool listen(); ///< to what comes next; false at the end

  pid_t child_ = -1;
  int out_ = -1, err_ = -1, patience_ms_;
  double began_ = 0;
  Finished result_;
};

Finished run_program(const std::vector<std::string>& arguments, const Surroundings& surroundings);
/// What `sh` makes of a line; it may be silent for as long as its test may last.
Finished run_shell(const std::string& line, Surroundings surroundings = {});

/// Words of a command line as a shell would split them; 'single quotes' keep spaces.
std::vector<std::string> words_of(const std::string& line);

} // namespace hopmesh::tests
