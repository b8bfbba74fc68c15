// Positions of a motion at a few times, and how far two such are apart.
#pragma once

#include "sim/run/simulation.h"

namespace hopmesh::run {

using Positions = std::vector<double>; ///< [nodes * 3], m

/// The step at whose end a time is taken: the nearest, 1-based.
std::uint64_t step_of_time(double time, double time_step);

/// Rms over all nodes of the distance, m.
double rms_distance(const Positions& a, const Positions& b);

/// Keeps the positions at the ends of a few steps.
class Snapshots : public StepSink {
 public:
  Snapshots(const std::vector<double>& times, double time_step);
  void step(const levels::StepRow& row, const levels::Mover& motion) override;

  std::vector<Positions> at; ///< one a time; empty where the motion did not come so far

 private:
  std::vector<std::uint64_t> wanted_;
};

} // namespace hopmesh::run
