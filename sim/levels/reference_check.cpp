#include "sim/levels/reference_check.h"

#include "rtl_model/spec/schedule.h"
#include "sim/levels/eigen_vectors.h"
#include "sim/levels/left_over.h"
#include "sim/levels/networks/told_error.h"
#include "sim/reference/rest.h"

#include <algorithm>
#include <cmath>
#include <functional>

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

namespace {

/// Where outputs are so many sweeps later.
using Swept = std::function<Vector(const Vector& from, std::uint32_t sweeps)>;

double alternation_of(const Swept& swept, const Vector& V) {
  const Vector once = swept(V, 1), later = swept(once, swings - 1), then = swept(later, 1);
  const double first = (once - V).norm(), away = (later - V).norm(), last = (then - later).norm();
  return first > 0 && away < first / 2 ? last / first : 0;
}

} // namespace

double alternation(const reference::Network& network, const reference::Order& order, const Vector& V,
                   const reference::NeuronRule& rule) {
  const auto swept = [&](const Vector& from, std::uint32_t sweeps) {
    return reference::relax(network, order, from, 0, sweeps, rule).V;
  };
  return alternation_of(swept, V);
}

namespace {

reference::Neuron neuron_of(spec::Output output) {
  switch (output) {
  case spec::Output::binary:
    return reference::Neuron::binary;
  case spec::Output::projected:
    return reference::Neuron::projected;
  case spec::Output::momentum:
    return reference::Neuron::momentum;
  default:
    return reference::Neuron::modified;
  }
}

double half_place(const spec::NumberFormat& format) {
  return std::ldexp(0.5, -format.fraction_bits());
}

} // namespace

reference::NeuronRule rule_of(const spec::ArraySpec& array, const std::vector<double>& momentum) {
  constexpr double sixteenth = 1.0 / 16; // of which the key tells a number
  reference::NeuronRule rule{neuron_of(array.output), array.relaxation * sixteenth, momentum};
  rule.nearness = half_place(array.formats.link); // what links show as the bound
  if (momentum.empty()) rule.momentum = reference::fista(static_cast<std::size_t>(array.momentum_entries));
  return rule;
}

reference::StepParameters motion_for(const scene::Scene& scene, const spec::ArraySpec& array) {
  reference::StepParameters motion = reference::step_parameters(scene);
  motion.rule = rule_of(array, scene.relax.momentum);
  if (scene.relax.stop == scene::Stop::sum) motion.share = scene.relax.share;
  return motion;
}

ReferenceCheck::ReferenceCheck(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array)
    : mesh_(mesh), motion_(motion_for(scene, array)),
      fixed_(scene.host.arithmetic == scene::Arithmetic::fixed), order_(order_for(mesh, array.schedule)),
      state_(reference::initial_state(mesh.mesh())), array_(array) {}

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
                                     const hm_relaxation& last) {
  reference::Answer answer;
  network_ = expanded(start, scale, answer.start);
  const reference::Network& network = network_;
  const std::size_t neurons = start.size();
  answer.V = by_node(std::vector<double>(built.output, built.output + neurons));
  answer.sweeps = last.sweeps;
  V_ = answer.V;
  const reference::BlockSweeps& twin = laid_out(network);
  const Swept swept = [&](const Vector& from, std::uint32_t sweeps) {
    if (motion_.rule.neuron == reference::Neuron::modified) return twin.swept(from, sweeps);
    return reference::relax(network, order_, from, -1, sweeps, motion_.rule).V;
  };
  const reference::Judgement judgement =
      motion_.rule.neuron == reference::Neuron::binary
          ? reference::judge_signs(network, order_, answer, motion_.max_sweeps)
          : reference::judge_answer(twin.network(), swept(answer.start, answer.sweeps), answer);
  const auto rms = [&](const Vector& a, const Vector& b) {
    return std::sqrt((a - b).squaredNorm() / static_cast<double>(neurons));
  };
  ReferenceError error;
  error.largest_output = (answer.V - judgement.rest).cwiseAbs().maxCoeff();
  error.rms_output = rms(answer.V, judgement.rest);
  error.rounding = rms(answer.V, judgement.same_sweeps);
  error.stopping = rms(judgement.same_sweeps, judgement.rest);
  error.energy_gap = judgement.gap;
  error.fall_left = fall_left(twin.network(), answer.start, answer.V, judgement.rest);
  error.network = network_difference(network, built);
  if (fixed_ && motion_.rule.neuron != reference::Neuron::binary)
    error.host = rest_difference(network, built, judgement.rest);
  if (!last.converged) error.alternation = alternation_of(swept, answer.V);
  return error;
}

RunRules rules_of(const reference::StepParameters& motion) {
  RunRules rules{motion.threshold, motion.share};
  const auto& m = motion.rule.momentum;
  rules.largest_momentum = m.empty() ? 0 : *std::max_element(m.begin(), m.end());
  return rules;
}

// What corrections added to V is no code, and no format bounds it.
void ReferenceCheck::certify(StepRow& row) const {
  const std::size_t neurons = mesh_.cells() * mesh_.components();
  const bool definite = motion_.formulation->increment != nullptr;
  if (row.step % steps_a_proof != 0 || !definite || neurons > most_proven) return;
  const auto told = told_error(network_, V_);
  if (!told) return;
  row.told_error = told->rms(neurons);
  if (row.residual || !row.converged || row.clipped > 0) return;
  RunRules rules = rules_of(motion_);
  rules.loads = true;
  const auto bound = ErrorBounds(network_, order_, false).of(array_, rules);
  if (bound) row.error_bound = bound->norm;
}

const reference::BlockSweeps& ReferenceCheck::laid_out(const reference::Network& network) {
  if (blocks_) {
    blocks_->take(network);
    sweeps_->refill();
  } else {
    blocks_.emplace(network, static_cast<Eigen::Index>(mesh_.components()));
    sweeps_.emplace(*blocks_, order_);
  }
  return *sweeps_;
}

namespace {

/// Where the matrix keeps a weight; -1 where it has none.
std::ptrdiff_t place_of(const reference::Matrix& W, std::size_t row, std::size_t column) {
  const auto* const columns = W.innerIndexPtr();
  const auto* const first = columns + W.outerIndexPtr()[row];
  const auto* const last = columns + W.outerIndexPtr()[row + 1];
  const auto* const at = std::lower_bound(first, last, static_cast<reference::Matrix::StorageIndex>(column));
  return at != last && *at == static_cast<reference::Matrix::StorageIndex>(column) ? at - columns : -1;
}

} // namespace

// Which weights the matrix has follows from the mesh alone: they are looked for once.
void ReferenceCheck::find_places(const reference::Matrix& W) {
  place_.assign(hm_weight_count(&mesh_.firmware()), -1);
  mesh_.each_weight(
      [&](std::size_t at, std::size_t row, std::size_t column) { place_[at] = place_of(W, row, column); });
}

// The firmware's rows against the reference's matrix, entry by entry.
double ReferenceCheck::network_difference(const reference::Network& network, const hm_network& built) {
  if (place_.empty()) find_places(network.W);
  double largest = 0, difference = 0;
  const auto compare = [&](double wanted, double found) {
    largest = std::max(largest, std::fabs(wanted));
    difference = std::max(difference, std::fabs(wanted - found));
  };
  const double* const weights = network.W.valuePtr();
  for (std::size_t k = 0; k < place_.size(); ++k)
    compare(place_[k] >= 0 ? weights[place_[k]] : 0, built.weight[k]);
  const std::size_t n = mesh_.components();
  for (std::size_t k = 0; k < mesh_.cells() * n; ++k)
    compare(network.I[static_cast<Eigen::Index>(mesh_.node_of_cell(k / n) * n + k % n)], built.bias[k]);
  return largest > 0 ? difference / largest : 0;
}

double ReferenceCheck::rest_difference(reference::Network network, const hm_network& built,
                                       const Vector& rest) {
  const auto n = static_cast<Eigen::Index>(mesh_.components());
  double* const weights = network.W.valuePtr();
  for (std::size_t k = 0; k < place_.size(); ++k)
    if (place_[k] >= 0) weights[place_[k]] = built.weight[k];
  for (std::size_t c = 0; c < mesh_.cells(); ++c)
    for (Eigen::Index p = 0; p < n; ++p)
      network.I[mesh_.node_of_cell(c) * n + p] = built.bias[static_cast<Eigen::Index>(c) * n + p];
  const Vector other = reference::rest_from(reference::BlockNetwork(network, n), rest).V;
  return std::sqrt((other - rest).squaredNorm() / static_cast<double>(mesh_.cells() * mesh_.components()));
}

} // namespace hopmesh::levels
