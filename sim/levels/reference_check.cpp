#include "sim/levels/reference_check.h"

#include "rtl_model/spec/schedule.h"
#include "sim/levels/left_over.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::levels {

using reference::Vector;

reference::Order order_for(const BuiltMesh& mesh, spec::Schedule schedule) {
  reference::Order order = spec::phases_of(mesh.topology(), schedule);
  const std::uint32_t n = static_cast<std::uint32_t>(mesh.components());
  for (auto& phase : order)
    for (std::uint32_t& neuron : phase) neuron = mesh.node_of_cell(neuron / n) * n + neuron % n;
  return order;
}

reference::State state_of(const StepState& state) {
  const auto vector = [](const std::vector<double>& values) -> Vector {
    return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
  };
  reference::State result;
  result.position = vector(state.position);
  result.velocity = vector(state.velocity);
  result.acceleration = vector(state.acceleration);
  result.previous_position = vector(state.previous_position);
  result.previous_velocity = vector(state.previous_velocity);
  result.step = state.step;
  return result;
}

double alternation(const reference::Network& network, const reference::Order& order, const Vector& V,
                   spec::Output output) {
  const auto swept = [&](const Vector& from, std::uint32_t sweeps) {
    return reference::relax(network, order, from, 0, sweeps, output).V;
  };
  const Vector once = swept(V, 1), later = swept(once, swings - 1), then = swept(later, 1);
  const double first = (once - V).norm(), away = (later - V).norm(), last = (then - later).norm();
  return first > 0 && away < first / 2 ? last / first : 0;
}

reference::StepParameters motion_for(const scene::Scene& scene, const spec::ArraySpec& array) {
  reference::StepParameters motion = reference::step_parameters(scene);
  motion.output = array.output;
  return motion;
}

ReferenceCheck::ReferenceCheck(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array)
    : mesh_(mesh), motion_(motion_for(scene, array)), order_(order_for(mesh, array.schedule)),
      state_(reference::initial_state(mesh.mesh())) {}

void ReferenceCheck::begin(const StepState& state, const double* node_force) {
  state_ = state_of(state);
  state_.V = by_node(state.output);
  if (node_force)
    motion_.node_force =
        Eigen::Map<const Vector>(node_force, static_cast<Eigen::Index>(state.position.size()));
}

Vector ReferenceCheck::by_node(const std::vector<double>& by_cell) const {
  const auto all = mesh_.by_node(by_cell);
  return Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
}

reference::Network ReferenceCheck::expanded(const std::vector<double>& start, double scale,
                                            Vector& V0) const {
  const scene::Mesh& mesh = mesh_.mesh();
  const reference::Formulation& formulation = *motion_.formulation;
  const bool known = !formulation.increment && motion_.expansions == 1;
  V0 = known ? formulation.start(mesh, state_, scale) : by_node(start);
  return formulation.network(mesh, motion_, state_, scale, V0);
}

ReferenceError ReferenceCheck::judge(const hm_network& built, const std::vector<double>& start, double scale,
                                     bool rested) const {
  Vector V0;
  const reference::Network network = expanded(start, scale, V0);
  const Vector wanted =
      reference::relax(network, order_, V0, motion_.threshold, motion_.max_sweeps, motion_.output).V;
  const std::size_t neurons = start.size();
  const Vector V = by_node(std::vector<double>(built.output, built.output + neurons));
  ReferenceError error;
  error.largest_output = (V - wanted).cwiseAbs().maxCoeff();
  error.rms_output = std::sqrt((V - wanted).squaredNorm() / static_cast<double>(neurons));
  const double rest = reference::network_energy(network, wanted);
  const double fall = reference::network_energy(network, V0) - rest;
  if (fall > 0) error.energy_gap = (reference::network_energy(network, V) - rest) / fall;
  error.network = network_difference(network, built);
  error.fall_left = fall_left(network, V0, V, order_, motion_.output);
  if (!rested) error.alternation = alternation(network, order_, V, motion_.output);
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

} // namespace hopmesh::levels
