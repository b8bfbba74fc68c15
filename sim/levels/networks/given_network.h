// A network that is no mesh's: W, I and a start of somebody's own, as the firmware, the array and the
// reference want it.
#pragma once

#include "firmware/network.h"
#include "rtl_model/spec/topology.h"
#include "sim/files/matrix_market.h"
#include "sim/reference/reference.h"

#include <string>
#include <vector>

namespace hopmesh::levels {

struct NetworkData {
  files::SparseMatrix W;
  std::vector<double> bias, start;     ///< empty: none was named
  std::vector<std::string> notes = {}; ///< what was changed in reading: a line each
};

/// Owns the arrays that hm_mesh points into; it neither moves nor copies. A neuron is a cell of its own; a
/// link joins two where W_ij or W_ji is not 0.
class GivenNetwork {
 public:
  /// `start_of_none`: what outputs start from where the data does not say.
  GivenNetwork(const NetworkData& data, double start_of_none);
  GivenNetwork(const GivenNetwork&) = delete;
  GivenNetwork& operator=(const GivenNetwork&) = delete;

  const reference::Network& network() const { return network_; }
  const Eigen::VectorXd& start() const { return start_; }
  const spec::Topology& topology() const { return topology_; }
  const hm_mesh& firmware() const { return firmware_; }
  /// W in the layout of the weight memory.
  const std::vector<double>& rows() const { return rows_; }
  std::size_t neurons() const { return topology_.cells(); }
  std::size_t weights() const { return static_cast<std::size_t>(network_.W.nonZeros()); }

  /// Of outputs V: -1/2 V'WV - I'V, and how far a step of s_i / N_i can still move one of them.
  /// + 0.0: an energy of nothing has no sign.
  double energy(const Eigen::VectorXd& V) const { return reference::network_energy(network_, V) + 0.0; }
  double kkt_violation(const Eigen::VectorXd& V) const { return reference::kkt_violation(network_, V); }

  /// The network that weights in the memory's layout and biases are.
  reference::Network network_of(const std::vector<double>& rows, const std::vector<double>& bias) const;

 private:
  void find_links(const files::SparseMatrix& W);
  void fill_rows(const files::SparseMatrix& W);
  void describe();

  spec::Topology topology_;
  reference::Network network_;
  Eigen::VectorXd start_;
  std::vector<double> rows_;
  std::vector<std::uint32_t> numbers_;
  hm_mesh firmware_{};
};

} // namespace hopmesh::levels
