#include "sim/levels/reference_check.h"

#include "rtl_model/spec/schedule.h"
#include "sim/levels/eigen_vectors.h"

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
  reference::State result;
  result.position = vector_of(state.position);
  result.velocity = vector_of(state.velocity);
  result.acceleration = vector_of(state.acceleration);
  result.previous_position = vector_of(state.previous_position);
  result.previous_velocity = vector_of(state.previous_velocity);
  result.step = state.step;
  return result;
}

double alternation(const reference::Network& network, const reference::Order& order, const Vector& V,
                   reference::Neuron neuron) {
  const auto swept = [&](const Vector& from, std::uint32_t sweeps) {
    return reference::relax(network, order, from, 0, sweeps, neuron).V;
  };
  const Vector once = swept(V, 1), later = swept(once, swings - 1), then = swept(later, 1);
  const double first = (once - V).norm(), away = (later - V).norm(), last = (then - later).norm();
  return first > 0 && away < first / 2 ? last / first : 0;
}

reference::Neuron neuron_of(spec::Output output) {
  return output == spec::Output::binary ? reference::Neuron::binary : reference::Neuron::modified;
}

reference::StepParameters motion_for(const scene::Scene& scene, const spec::ArraySpec& array) {
  reference::StepParameters motion = reference::step_parameters(scene);
  motion.neuron = neuron_of(array.output);
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
  return vector_of(mesh_.by_node(by_cell));
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
      reference::relax(network, order_, V0, motion_.threshold, motion_.max_sweeps, motion_.neuron).V;
  const std::size_t neurons = start.size();
  const Vector V = by_node(std::vector<double>(built.output, built.output + neurons));
  ReferenceError error;
  error.largest_output = (V - wanted).cwiseAbs().maxCoeff();
  error.rms_output = std::sqrt((V - wanted).squaredNorm() / static_cast<double>(neurons));
  const double rest = reference::network_energy(network, wanted);
  const double fall = reference::network_energy(network, V0) - rest;
  if (fall > 0) error.energy_gap = (reference::network_energy(network, V) - rest) / fall;
  error.network = network_difference(network, built);
  if (!rested) error.alternation = alternation(network, order_, V, motion_.neuron);
  return error;
}

// The firmware's rows against the reference's matrix, entry by entry.
double ReferenceCheck::network_difference(const reference::Network& network, const hm_network& built) const {
  double largest = 0, difference = 0;
  const auto compare = [&](double wanted, double found) {
    largest = std::max(largest, std::fabs(wanted));
    difference = std::max(difference, std::fabs(wanted - found));
  };
  const std::vector<double> bias = mesh_.by_cell(network.I);
  for (std::size_t k = 0; k < bias.size(); ++k) compare(bias[k], built.bias[k]);
  mesh_.each_weight([&](std::size_t place, std::uint32_t row, std::uint32_t column) {
    compare(network.W.coeff(row, column), built.weight[place]);
  });
  return largest > 0 ? difference / largest : 0;
}

} // namespace hopmesh::levels
