// What a network does: neurons answer their own inputs, phase by phase.
#include "sim/networks/solvers/all_solvers.h"

#include <algorithm>

namespace hopmesh::solvers {
namespace {

/// How much a neuron yields to its input. Throws Unfit where the exact rule has no answer.
Vector divisors(const Problem& problem, Rule rule) {
  if (rule == Rule::hopfield) return normalisers(problem);
  Vector curvature = -problem.W.diagonal();
  if (!(curvature.minCoeff() > 0))
    throw Unfit("needs every W_ii below 0: a neuron here has no least energy of its own");
  return curvature;
}

class Neurons : public Solver {
 public:
  Neurons(const Problem& problem, Rule rule, double share, Order order)
      : Solver(problem), rule_(rule), share_(share), order_(std::move(order)),
        divisor_(divisors(problem, rule)), next_(problem.start) {}

  void sweep() override {
    for (const auto& phase : order_) fire_together(phase);
  }

 private:
  // All read the outputs from before the phase, so none is written until all have read.
  void fire_together(const std::vector<std::uint32_t>& phase) {
    for (const std::uint32_t i : phase) next_[i] = answer(i);
    for (const std::uint32_t i : phase) V_[i] = next_[i];
  }

  double answer(std::uint32_t i) const {
    const double u = input(problem_, V_, i) / divisor_[i], V = V_[i];
    if (rule_ == Rule::exact) return std::clamp(V + share_ * u, -1.0, 1.0);
    return V + share_ * u * (u >= 0 ? 1 - V : 1 + V);
  }

  const Rule rule_;
  const double share_;
  const Order order_;
  const Vector divisor_;
  Vector next_;
};

} // namespace

std::unique_ptr<Solver> make_neurons(const Problem& problem, Rule rule, double share, Order order) {
  return std::make_unique<Neurons>(problem, rule, share, std::move(order));
}

} // namespace hopmesh::solvers
