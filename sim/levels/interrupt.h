// The user's wish to stop: Ctrl-C or a polite kill.
#pragma once

#include <atomic>

namespace hopmesh::levels {

/// Set by the first SIGINT or SIGTERM once they are caught; the second ends the process at once.
extern std::atomic<bool> stop_requested;
void catch_interrupts();

} // namespace hopmesh::levels
