#include "sim/levels/array_mover.h"

#include "sim/levels/bus_array.h"
#include "sim/levels/bus_error.h"
#include "sim/levels/left_over.h"
#include "sim/levels/processor_time.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::levels {

namespace {

const hm_formulation* formulation_named(const std::string& name) {
  for (const hm_formulation* known : hm_formulations)
    if (known->name == name) return known;
  throw std::logic_error("no formulation " + name);
}

} // namespace

hm_step_parameters step_parameters(const scene::Scene& scene) {
  hm_step_parameters m{};
  m.formulation = formulation_named(scene.formulation_name());
  m.time_step = scene.motion.time_step;
  m.friction = scene.motion.friction;
  m.mass = scene.mesh.mass;
  m.drag = scene.force.drag;
  m.gamma = scene.probe.gamma;
  m.beta = scene.probe.beta;
  m.acceleration_memory = scene.probe.acceleration_memory;
  m.energy_of_all_springs = scene.probe.energy_springs == scene::EnergySprings::all;
  m.force_on_acceleration = scene.probe.force_on == scene::ForceOn::acceleration;
  for (std::size_t x = 0; x < 3; ++x)
    m.force[x] = scene.force.gravity[x] + (scene.force.wind ? (*scene.force.wind)[x] : 0.0);
  m.threshold = scene.relax.threshold;
  m.max_sweeps = static_cast<std::uint32_t>(scene.relax.max_sweeps);
  m.expansions = static_cast<std::uint32_t>(scene.relax.expansions);
  m.refinements = static_cast<std::uint32_t>(scene.relax.refinements);
  if (scene.relax.reload == scene::Reload::bias)
    m.reload_every = static_cast<std::uint32_t>(scene.relax.reload_every);
  return m;
}

ArrayMover::ArrayMover(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array,
                       ArrayPort& port, bool check)
    : mesh_(mesh), port_(port), profile_(port, array, mesh.topology()), words_(profile_),
      motion_(step_parameters(scene)), relax_(scene.relax), memory_(mesh, motion_.formulation->looks_back) {
  if (relax_.corrects()) memory_.make_room();
  HostBus& bus = scene.host.dma ? static_cast<HostBus&>(profile_) : words_;
  host_ = make_host(scene, array, {bus, mesh.firmware(), motion_, relax_, memory_});
  if (scene.force.image) image_.emplace(scene);
  if (check) check_.emplace(scene, mesh, array);
  const bool signs = array.output == spec::Output::binary;
  if (!signs && mesh.topology().neurons() <= LeftOver::most_neurons) left_over_.emplace(mesh);
}

// The array is looked at with the first step, when every port of the process has been made.
void ArrayMover::open() {
  check_opened(host_->open(), driver());
  opened_ = true;
  put_kept_back();
}

// Reach, inertia, step, softness, shift; then the weights that the array has.
namespace {
constexpr std::size_t kept_figures = 5;
}

void ArrayMover::keep() {
  if (!relax_.corrects()) return;
  const hm_kept& kept = memory_.state.kept;
  std::vector<double>& all = memory_.now.kept;
  all = {kept.reach, kept.inertia, static_cast<double>(kept.step), kept.softness,
         static_cast<double>(driver().shift)};
  const std::vector<double> loaded = host_->loaded_weights();
  all.insert(all.end(), loaded.begin(), loaded.end());
}

// An array that was just made has no weights yet.
void ArrayMover::put_kept_back() {
  const std::vector<double>& all = memory_.now.kept;
  if (all.size() < kept_figures) return;
  memory_.state.kept = {all[0], all[1], static_cast<std::uint64_t>(all[2]), all[3]};
  const std::vector<double> loaded(all.begin() + kept_figures, all.end());
  if (!loaded.empty()) levels::check(host_->restore(loaded, static_cast<int>(all[4])));
}

namespace {

void tell_corrections(const hm_refinement& made, StepRow& row) {
  row.refinements = made.corrections;
  row.refused = made.refused;
  row.residual = made.residual;
}

} // namespace

StepRow ArrayMover::advance() {
  if (!opened_) open();
  const std::uint64_t step = memory_.state.step, bus_before = bus_cycles();
  rest_ = memory_.now.output;
  if (image_) motion_.node_force = image_->at(memory_.now.position).data();
  if (check_) check_->begin(state(), motion_.node_force);
  port_.begin_step(step);
  step_ = {};
  const int error = host_->step(step_);
  const hm_step_result& result = step_.result;
  if (error == HM_ERROR_STOPPED) {
    std::copy(rest_.begin(), rest_.end(), memory_.now.output.begin());
    throw Stopped();
  }
  if (error == HM_ERROR_NUMBER) throw LostMotion(error_text(error));
  if (error != HM_ERROR_LOST) check(error);
  port_.end_step(step);
  if (error == HM_ERROR_LOST)
    throw LostMotion("node " + std::to_string(result.lost_node) + " has no finite position");

  StepRow row;
  row.step = step;
  row.time = static_cast<double>(memory_.state.step) * motion_.time_step;
  row.sweeps = result.relaxation.sweeps;
  row.cycles = result.relaxation.cycles;
  row.converged = result.relaxation.converged;
  look_back(row);
  if (relax_.corrects()) tell_corrections(result.refinement, row);
  row.clipped = driver().clipped;
  row.vanished = driver().vanished;
  if (step_.instructions > 0) row.instructions = static_cast<double>(step_.instructions);
  row.bus_cycles = bus_cycles() - bus_before;
  row.saturated = static_cast<std::uint64_t>(std::count_if(
      memory_.now.output.begin(), memory_.now.output.end(), [](double V) { return std::fabs(V) >= 1; }));
  measure(mesh_.mesh(), memory_.now.position.data(), memory_.now.velocity.data(), row);
  if (check_) {
    const double began = processor_seconds();
    row.error = check_->judge(memory_.state.network, memory_.start, memory_.state.scale, step_.last);
    row.alternation = row.error->alternation;
    row.fall_left = row.error->fall_left;
    row.host_error = row.error->host;
    check_->certify(row);
    judging_seconds_ += processor_seconds() - began;
  }
  keep();
  row.hash = state_hash(memory_.now);
  return row;
}

// step_columns.h tells people: every eighth step.
static_assert(LeftOver::steps_a_look == 8 && ReferenceCheck::steps_a_proof == 8);

// Signs have no way down but their own rule.
void ArrayMover::look_back(StepRow& row) {
  const hm_network& network = memory_.state.network;
  row.input_left = input_left(mesh_.firmware(), network);
  if (left_over_ && row.step % LeftOver::steps_a_look == 0)
    row.fall_seen = left_over_->look(network, memory_.start, step_.sweeps.back());
}

HostCounts ArrayMover::host_counts() const {
  return {host_->functions(), host_->memory_bytes()};
}

std::uint64_t ArrayMover::bus_cycles() const {
  return BusArray(port_.bus(), mesh_.topology()).bus_cycles();
}

std::vector<SignalRange> ArrayMover::ranges() const {
  auto all = profile_.ranges();
  for (const SignalRange& range : port_.inner_ranges()) all.push_back(range);
  for (SignalRange& range : all)
    for (const SignalRange& before : seen_) {
      if (before.signal != range.signal) continue;
      range.least = std::min(range.least, before.least);
      range.largest = std::max(range.largest, before.largest);
    }
  return all;
}

StepState ArrayMover::state() const {
  StepState state = memory_.now;
  state.step = memory_.state.step;
  return state;
}

// Values are copied into place: the firmware's pointers stay what they are.
void ArrayMover::restore(const StepState& state, const std::vector<SignalRange>& seen) {
  const auto from = parts_of(state);
  const auto to = parts_of(memory_.now);
  for (std::size_t k = 0; k < to.size(); ++k) {
    if (to[k].second == &memory_.now.kept) continue;
    if (from[k].second->size() != to[k].second->size()) throw std::logic_error("the state of another mesh");
    std::copy(from[k].second->begin(), from[k].second->end(), to[k].second->begin());
  }
  memory_.state.step = state.step;
  memory_.now.kept = state.kept;
  if (opened_) put_kept_back();
  seen_ = seen;
}

} // namespace hopmesh::levels
