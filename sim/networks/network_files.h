// A network of somebody's own, read from files and judged.
#pragma once

#include "sim/levels/networks/given_network.h"

#include <string>

namespace hopmesh::networks {

using levels::NetworkData;

struct NetworkFiles {
  std::string weights, bias,
      start;               ///< Matrix Market; no bias: 0; no start: 0, or +1 where outputs are binary
  bool asymmetric = false; ///< W may be so: then no proof says that energy falls
};

/// Throws input::InputError where W is not square, or not symmetric, sizes do not match, a start lies outside
/// the box or the network is larger than an array's windows. Where W and its transpose differ by round-off
/// alone, far below the last place of any weight, their mean is taken, and told.
NetworkData read_network(const NetworkFiles& files);

/// Outputs to start from, as many as there are neurons.
std::vector<double> read_start(const std::string& file, std::size_t neurons);

} // namespace hopmesh::networks
