#include "sim/run/snapshots.h"

#include <cmath>

namespace hopmesh::run {

std::uint64_t step_of_time(double time, double time_step) {
  return static_cast<std::uint64_t>(std::llround(time / time_step));
}

double rms_distance(const Positions& a, const Positions& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  const std::size_t nodes = a.size() / 3;
  return std::sqrt(sum / static_cast<double>(nodes));
}

Snapshots::Snapshots(const std::vector<double>& times, double time_step) : at(times.size()) {
  for (double time : times) wanted_.push_back(step_of_time(time, time_step));
}

void Snapshots::step(const levels::StepRow& row, const levels::Mover& motion) {
  for (std::size_t k = 0; k < wanted_.size(); ++k)
    if (row.step + 1 == wanted_[k]) at[k] = motion.positions();
}

} // namespace hopmesh::run
