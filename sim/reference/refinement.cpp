#include "sim/reference/refinement.h"

#include <cmath>

namespace hopmesh::reference {
namespace {

constexpr double good_part = 0.5;    // of the range: what a correction is meant to use at most
constexpr double clipped_part = 0.9; // of the range: a correction that far is done anew, at a larger unit
constexpr int most_retries = 100, most_shortenings = 8;
constexpr double last_places = 0x1p-40;

double largest_of(const Vector& values) {
  return values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff();
}

/// The next power of two.
double unit_for(double change) {
  return change > 0 ? std::exp2(std::ceil(std::log2(change / good_part))) : 1;
}

/// The network without the neurons that a bound holds: who is still free asks what is left.
Network without_held(const Network& network, const Vector& V, const Vector& free_residual) {
  const Vector residual = network.W * V + network.I;
  const auto held = [&](Eigen::Index k) { return residual[k] != 0 && free_residual[k] == 0; };
  Network rest{network.W, free_residual};
  for (Eigen::Index row = 0; row < rest.W.outerSize(); ++row)
    for (Matrix::InnerIterator w(rest.W, row); w; ++w)
      if (held(row) || held(w.col())) w.valueRef() = 0;
  return rest;
}

class Refining {
 public:
  Refining(const Network& network, const Order& order, const Stop& stop, const NeuronRule& rule,
           Relaxation& answer)
      : network_(network), order_(order), stop_(stop), rule_(rule), answer_(answer) {}

  /// The answer itself tells how far a residual moves outputs.
  void learn_from(const Vector& V0) {
    const double residual = largest_of(movable_input(network_, V0));
    if (residual > 0) softness_ = largest_of(answer_.V - V0) / residual;
  }

  double left() const { return largest_of(movable_input(network_, answer_.V)); }

  /// 0 where V stays as it is; what it moved by otherwise.
  bool correct() {
    const Vector change = answered();
    for (int k = 0; k <= most_shortenings; ++k) {
      const Vector wanted = answer_.V + std::ldexp(1.0, -k) * change;
      const Vector boxed = wanted.cwiseMin(1).cwiseMax(-1);
      if (fall(network_, answer_.V, boxed) > 0) {
        answer_.V = boxed;
        return true;
      }
      if (boxed == wanted) break;
    }
    is_noise_ = largest_of(change) <= last_places;
    return false;
  }

  bool is_noise() const { return is_noise_; }

 private:
  // A change that does not fit its unit is asked for again.
  Vector answered() {
    const Vector residual = movable_input(network_, answer_.V);
    const double whole = largest_of(residual);
    const double diagonal = largest_of(network_.W.diagonal());
    double unit = unit_for(softness_ > 0 ? softness_ * whole : whole / diagonal);
    Network rest = without_held(network_, answer_.V, residual);
    for (int k = 0;; ++k, unit *= 4) {
      rest.I = residual / unit;
      const Relaxation found = relax(rest, order_, Vector::Zero(residual.size()), stop_, rule_);
      answer_.sweeps += found.sweeps;
      answer_.converged = found.converged;
      if (largest_of(found.V) > clipped_part && k < most_retries) continue;
      softness_ = unit * largest_of(found.V) / whole;
      return unit * found.V;
    }
  }

  const Network& network_;
  const Order& order_;
  const Stop stop_;
  const NeuronRule& rule_;
  Relaxation& answer_;
  double softness_ = 0;
  bool is_noise_ = false;
};

} // namespace

Refinement refine(const Network& network, const Order& order, const Vector& V0, const Stop& stop,
                  const NeuronRule& rule, std::uint32_t most, Relaxation& answer) {
  Refining refining(network, order, stop, rule, answer);
  refining.learn_from(V0);
  Refinement result;
  while (result.corrections < most && result.refused == 0 && refining.left() > 0) {
    if (refining.correct())
      ++result.corrections;
    else if (refining.is_noise())
      break;
    else
      ++result.refused;
  }
  const double whole = largest_of(network.I);
  result.residual = whole > 0 ? refining.left() / whole : 0;
  return result;
}

} // namespace hopmesh::reference
