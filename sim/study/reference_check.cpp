#include "sim/study/reference_check.h"

#include "rtl_model/spec/schedule.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::study {

using reference::Vector;

reference::Order order_for(const BuiltMesh& mesh, spec::Schedule schedule) {
  reference::Order order = spec::phases_of(mesh.topology(), schedule);
  const std::uint32_t n = static_cast<std::uint32_t>(mesh.components());
  for (auto& phase : order)
    for (std::uint32_t& neuron : phase) neuron = mesh.node_of_cell(neuron / n) * n + neuron % n;
  return order;
}

ReferenceCheck::ReferenceCheck(const scene::Scene& scene, const BuiltMesh& mesh, spec::Schedule schedule)
    : mesh_(mesh), motion_(reference::motion_of(scene)), order_(order_for(mesh, schedule)),
      state_(reference::initial_state(mesh.mesh())) {}

void ReferenceCheck::begin(const double* position, const double* velocity, const double* acceleration,
                           const std::vector<double>& V, std::uint64_t step) {
  const auto count = static_cast<Eigen::Index>(3 * mesh_.nodes());
  state_.position = Eigen::Map<const Vector>(position, count);
  state_.velocity = Eigen::Map<const Vector>(velocity, count);
  state_.acceleration = Eigen::Map<const Vector>(acceleration, count);
  const auto all = mesh_.by_node(V);
  state_.V = Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
  state_.step = step;
}

ReferenceError ReferenceCheck::judge(const hm_network& built) const {
  reference::State state = state_;
  const reference::Step step = reference::advance(mesh_.mesh(), motion_, order_, state);
  const std::size_t neurons = mesh_.cells() * mesh_.components();
  const auto all = mesh_.by_node(std::vector<double>(built.output, built.output + neurons));
  const Eigen::Map<const Vector> V(all.data(), static_cast<Eigen::Index>(all.size()));
  const Vector& wanted = step.relaxation.V;
  ReferenceError error;
  error.largest_output = (V - wanted).cwiseAbs().maxCoeff();
  error.rms_output = std::sqrt((V - wanted).squaredNorm() / static_cast<double>(neurons));
  const double rest = reference::network_energy(step.network, wanted);
  const double fall = reference::network_energy(step.network, step.V0) - rest;
  if (fall > 0) error.energy_gap = (reference::network_energy(step.network, V) - rest) / fall;
  error.network = network_difference(step.network, built);
  return error;
}

// The firmware's rows against the reference's matrix, entry by entry.
double ReferenceCheck::network_difference(const reference::Network& network, const hm_network& built) const {
  const hm_mesh& m = mesh_.firmware();
  double largest = 0, difference = 0;
  const auto compare = [&](double wanted, double found) {
    largest = std::max(largest, std::fabs(wanted));
    difference = std::max(difference, std::fabs(wanted - found));
  };
  for (std::uint32_t c = 0; c < m.cells; ++c)
    for (std::uint32_t p = 0; p < m.components; ++p) {
      const std::uint32_t row = m.node_of_cell[c] * m.components + p;
      compare(network.I[row], built.bias[c * m.components + p]);
      const double* weight = built.weight + hm_row_offset(&m, c, p);
      for (std::uint32_t t = 0; t < hm_row_length(&m, c); ++t) {
        const std::uint32_t source = t < m.components ? c : m.link_to[m.first_link[c] + t / m.components - 1];
        compare(network.W.coeff(row, m.node_of_cell[source] * m.components + t % m.components), weight[t]);
      }
    }
  return largest > 0 ? difference / largest : 0;
}

} // namespace hopmesh::study
