// A firing of one neuron as numbers: what goes in, and every number on the way to what comes out, in the
// order of docs/hardware/datapath.md. All are raw codes.
#pragma once

#include <cstdint>
#include <vector>

namespace hopmesh::spec {

/// `link` holds L of the sources of `weight`, tap by tap; `state` is V before, within [-1, 1].
struct FiringInputs {
  std::vector<std::int32_t> weight, link;
  std::int32_t bias = 0, state = 0;
  std::uint32_t own_tap = 0;     ///< with `projected`: number of the tap whose source is the neuron itself
  std::int32_t extrapolated = 0; ///< with `momentum`: Y before, within [-1, 1]
  std::int32_t momentum = 0;     ///< with `momentum`: m of the sweep, a code of momentum_format
};

/// What an array does not have is 0: N where it is not summed, the reciprocal where there is none or N is 0,
/// R where no stage multiplies by it. A sweep that ends in a restart takes `extrapolated` and `link` back.
struct FiringSteps {
  std::vector<std::int64_t> sum; ///< s as the bias leaves it, then after each beat
  std::int64_t norm = 0;         ///< what divides s: N, or |w_ii| with `projected`
  std::int64_t reciprocal = 0;   ///< r
  std::int64_t places = 0;       ///< s r * 2^-places counts in the drive's last place
  /// u before the limiter, a code of the drive; u itself with `projected` and `momentum`, whose quotients
  /// need not fit it.
  std::int64_t ratio = 0;
  std::int64_t drive = 0;        ///< u
  std::int64_t pull = 0;         ///< R
  std::int64_t product = 0;      ///< R u, or m Delta V with `momentum`; exact
  std::int64_t change = 0;       ///< Delta V
  std::int32_t state = 0;        ///< V after
  std::int32_t link = 0;         ///< L of that, or of Y
  std::int32_t extrapolated = 0; ///< Y after

  bool operator==(const FiringSteps& o) const {
    return sum == o.sum && norm == o.norm && reciprocal == o.reciprocal && places == o.places &&
           ratio == o.ratio && drive == o.drive && pull == o.pull && product == o.product &&
           change == o.change && state == o.state && link == o.link && extrapolated == o.extrapolated;
  }
};

} // namespace hopmesh::spec
