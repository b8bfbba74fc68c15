// The widest that s and u have swung, over all neurons and runs: what a format study wants to know. Not
// hardware.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hopmesh::systemc {

struct Extremes {
  std::int64_t least_sum = 0, largest_sum = 0, least_drive = 0, largest_drive = 0;

  void note(std::int64_t sum, std::int64_t drive) {
    least_sum = std::min(least_sum, sum);
    largest_sum = std::max(largest_sum, sum);
    least_drive = std::min(least_drive, drive);
    largest_drive = std::max(largest_drive, drive);
  }
};

} // namespace hopmesh::systemc
