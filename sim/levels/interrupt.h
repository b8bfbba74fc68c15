// The user's wish to stop: Ctrl-C, a polite kill, or a terminal that is closed.
#pragma once

#include <atomic>

namespace hopmesh::levels {

/// Set by the first SIGINT, SIGTERM or SIGHUP once they are caught; the second ends the process at once. A
/// SIGHUP that was ignored before (nohup) stays so.
extern std::atomic<bool> stop_requested;
void catch_interrupts();

} // namespace hopmesh::levels
