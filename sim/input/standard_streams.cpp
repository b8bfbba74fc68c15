#include "sim/input/standard_streams.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <system_error>
#include <unistd.h>

namespace hopmesh::input {

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest number that is free is the one just found closed.
    if (::open("/dev/null", O_RDWR) != stream) std::_Exit(2); // no /dev/null: nothing can be said either
  }
}

void say(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

bool stdout_failed() noexcept {
  return std::ferror(stdout) != 0 || !std::cout;
}

void finish_stdout() {
  std::cout.flush();
  const bool failed = std::fflush(stdout) != 0;
  const int reason = failed ? errno : EIO;
  if (failed || stdout_failed()) throw std::system_error(reason, std::generic_category(), "stdout");
}

} // namespace hopmesh::input
