#include "sim/files/standard_streams.h"

#include "sim/files/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <iostream>
#include <unistd.h>

namespace hopmesh::files {

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
  if (failed || stdout_failed())
    throw WriteError(fmt::format("stdout: cannot write: {}", std::strerror(reason)));
}

} // namespace hopmesh::files
