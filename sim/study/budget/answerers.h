// How the references of a budget answer the networks of their steps.
#pragma once

#include "sim/levels/array_mover.h"
#include "sim/reference/reference.h"
#include "sim/run/simulation.h"

namespace hopmesh::study {

/// [steps][relaxations] sweeps that an array took.
using SweepsOfSteps = std::vector<std::vector<std::uint32_t>>;

/// Watches an array's steps.
class SweepWatch : public run::StepSink {
 public:
  explicit SweepWatch(const levels::ArrayMover& array) : array_(array) {}
  void step(const levels::StepRow&, const levels::Mover&) override { of.push_back(array_.last_sweeps()); }

  SweepsOfSteps of;

 private:
  const levels::ArrayMover& array_;
};

/// By as many sweeps as the array took. A reference that looks longer for its scale takes the array's last
/// count again; behind the array's last step none is taken.
reference::Answerer by_equal_sweeps(SweepsOfSteps sweeps, reference::Neuron neuron);

/// By the rest: of signs where the rule itself comes to, else the one that lies down from where the rule
/// would have stopped. Converged where it is found. `components`: of a node.
reference::Answerer by_rest(const reference::StepParameters& motion, Eigen::Index components);

} // namespace hopmesh::study
