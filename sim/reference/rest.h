// The rest of a network: the least of E = -1/2 V'WV - I'V on the box [-1, 1], to the last place that double
// has, however slowly the neurons' own rule would come there (docs/method/theory.md, section 3).
#pragma once

#include "sim/reference/block_network.h"

namespace hopmesh::reference {

struct Rest {
  Vector V;
  /// Largest violation of the KKT conditions: how far a step of s_i / sum_j |W_ij| can move V_i in the box.
  double violation = 0;
  std::uint32_t products = 0; ///< of the matrix with a vector: what it cost
  bool found = false;         ///< the violation is rounding
};

/// Downhill from V in the box. Where -W is positive definite the rest is the only one; elsewhere it is the
/// one that the way down leads to, and may be none of the deepest.
Rest rest_from(const BlockNetwork& network, const Vector& V, std::uint32_t most_products = 200'000);

/// Some of that way, for so many products: nowhere on it does the energy climb.
Vector way_down(const BlockNetwork& network, const Vector& V, std::uint32_t products);

/// E(V) - E(rest), without the rounding of two large energies. Where -W is positive definite it is below 0 by
/// rounding at most.
double energy_above(const BlockNetwork& network, const Vector& rest, const Vector& V);

} // namespace hopmesh::reference
