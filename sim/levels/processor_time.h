// How much of a processor this program has used: what a busy neighbour disturbs less than the clock on the
// wall.
#pragma once

#include <ctime>

namespace hopmesh::levels {

/// s of all threads of this process since it began.
inline double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

} // namespace hopmesh::levels
