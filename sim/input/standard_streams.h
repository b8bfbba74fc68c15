// Descriptors 0 to 2 as a process finds them: closed, full, or a terminal that is gone. None of that may
// reach into the results.
#pragma once

#include <string_view>

namespace hopmesh::input {

/// First of all in a process: where 0, 1 or 2 is closed, /dev/null takes its place, or the next file that is
/// opened would be written between its lines by every message.
void open_standard_streams();

/// Writes to stderr if that can be. A message that nobody can read is no reason to lose work.
void say(std::string_view text) noexcept;

/// Last of all: everything printed has left this process. Throws std::system_error where some of it is lost.
void finish_stdout();

/// Was anything lost on its way to stdout so far?
bool stdout_failed() noexcept;

} // namespace hopmesh::input
