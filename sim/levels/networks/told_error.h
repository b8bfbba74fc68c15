// What a single solve tells of an answer (docs/method/theory.md, section 10): how far outputs are from the
// least of a definite network, without knowing that least.
#pragma once

#include "sim/reference/relaxation.h"

#include <optional>

namespace hopmesh::levels {

struct ToldError {
  Eigen::VectorXd error; ///< V - V*, to the rounding of the solve; 0 where a bound holds
  /// Outputs at a bound that s pushes them against. Where there are none, the error is the error itself;
  /// else an estimate, of who is between the bounds, which takes those that are held for held at the least.
  std::size_t held = 0;
  std::size_t stopped =
      0; ///< others that the solve takes out of the box: at the bound, and again an estimate

  bool is_estimate() const { return held + stopped > 0; }

  double rms(std::size_t neurons) const;
};

/// Of outputs V in the box, by a factorisation of -W on those that no bound holds and a solve with s = WV +
/// I; none where -W is not positive definite on them. Neurons without a weight, as those of pinned nodes,
/// have no part in it.
std::optional<ToldError> told_error(const reference::Network& network, const Eigen::VectorXd& V);

/// Neurons that have a weight.
std::vector<Eigen::Index> weighed_neurons(const reference::Network& network);

} // namespace hopmesh::levels
