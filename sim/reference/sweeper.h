// A network whose neurons fire, sweep by sweep. A relaxation is made of such sweeps (relax() of
// relaxation.h); whoever wants to look at each of them holds a Sweeper.
#pragma once

#include "sim/reference/relaxation.h"

namespace hopmesh::reference {

/// What a sweep came to.
struct Swept {
  double largest_change = 0; ///< |dV|
  double largest_input = 0;  ///< |s| of the neurons that may still move
};

class Sweeper {
 public:
  /// Network and order must outlive it. Momentum wants an order of a single phase; throws std::logic_error.
  Sweeper(const Network& network, const Order& order, const NeuronRule& rule, Vector V);
  Sweeper(const Network& network, Order&& order, const NeuronRule& rule, Vector V) = delete;

  /// Fires every neuron of the order once.
  Swept sweep();
  const Vector& V() const { return V_; }

 private:
  void fire_together(const std::vector<std::uint32_t>& phase);
  bool may_move(double s, double from) const;
  double fired(Eigen::Index neuron, double s) const;
  void look_ahead();

  const Network& network_;
  const Order& order_;
  const NeuronRule rule_;
  const Vector divisor_; ///< of s
  Vector V_;
  Vector Y_;          ///< momentum: what neurons see instead of V
  Vector s_, change_; ///< of the sweep at hand
  Swept swept_;
  double agreement_ = 0;  ///< momentum: sum of sign(s) dV
  std::size_t entry_ = 0; ///< momentum: of the table, for the next sweep
};

/// Sweeps on until it may stop; what counts as the first sweep is the next one.
Relaxation relax(Sweeper& sweeper, const Stop& stop);

} // namespace hopmesh::reference
