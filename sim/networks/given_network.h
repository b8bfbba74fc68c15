// A network that is no mesh's: W, I and a start of somebody's own, read and judged, and as the firmware, the
// array and the reference want it.
#pragma once

#include "firmware/network.h"
#include "rtl_model/spec/topology.h"
#include "sim/files/matrix_market.h"
#include "sim/reference/reference.h"

#include <string>
#include <vector>

namespace hopmesh::networks {

struct NetworkFiles {
  std::string weights, bias,
      start;               ///< Matrix Market; no bias: 0; no start: 0, or +1 where outputs are binary
  bool asymmetric = false; ///< W may be so: then no proof says that energy falls
};

struct NetworkData {
  files::SparseMatrix W;
  std::vector<double> bias, start;     ///< empty: none was named
  std::vector<std::string> notes = {}; ///< what was changed in reading: a line each
};

/// Throws input::InputError where W is not square, or not symmetric, sizes do not match, a start lies outside
/// the box or the network is larger than an array's windows. Where W and its transpose differ by round-off
/// alone, far below the last place of any weight, their mean is taken, and told.
NetworkData read_network(const NetworkFiles& files);

/// Outputs to start from, as many as there are neurons.
std::vector<double> read_start(const std::string& file, std::size_t neurons);

/// Owns the arrays that hm_mesh points into; it neither moves nor copies. A neuron is a cell of its own; a
/// link joins two where W_ij or W_ji is not 0.
class GivenNetwork {
 public:
  /// `start_of_none`: what outputs start from where the data does not say.
  GivenNetwork(const NetworkData& data, double start_of_none);
  GivenNetwork(const GivenNetwork&) = delete;
  GivenNetwork& operator=(const GivenNetwork&) = delete;

  const reference::Network& network() const { return network_; }
  const reference::Vector& start() const { return start_; }
  const spec::Topology& topology() const { return topology_; }
  const hm_mesh& firmware() const { return firmware_; }
  /// W in the layout of the weight memory.
  const std::vector<double>& rows() const { return rows_; }
  std::size_t neurons() const { return topology_.cells(); }
  std::size_t weights() const { return static_cast<std::size_t>(network_.W.nonZeros()); }

  /// The network that weights in the memory's layout and biases are.
  reference::Network network_of(const std::vector<double>& rows, const std::vector<double>& bias) const;

 private:
  void find_links(const files::SparseMatrix& W);
  void fill_rows(const files::SparseMatrix& W);
  void describe();

  spec::Topology topology_;
  reference::Network network_;
  reference::Vector start_;
  std::vector<double> rows_;
  std::vector<std::uint32_t> numbers_;
  hm_mesh firmware_{};
};

} // namespace hopmesh::networks
