#include "sim/study/array_motion.h"

#include "firmware/registers.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hopmesh::study {

std::string error_text(int error) {
  switch (error) {
  case HM_ERROR_BUS:
    return "the bus refused a transfer";
  case HM_ERROR_ID:
    return "there is no Hopmesh array of this version behind the bus";
  case HM_ERROR_MESH:
    return "the array was built for another mesh";
  case HM_ERROR_NUMBER:
    return "a weight, a bias or a start value is not finite";
  case HM_ERROR_BUSY:
    return "the array was running when it should not";
  case HM_ERROR_SPACE:
    return "the driver's buffer is too small";
  default:
    return "error " + std::to_string(error);
  }
}

hm_motion motion_of(const scene::Scene& scene) {
  hm_motion m{};
  m.time_step = scene.motion.time_step;
  m.friction = scene.motion.friction;
  m.mass = scene.mesh.mass;
  m.drag = scene.force.drag;
  m.rule = HM_PROBE;
  if (scene.motion.formulation == scene::Formulation::incremental)
    m.rule = scene.incremental.rule == "bdf2" ? HM_BDF2 : HM_BACKWARD_EULER;
  else
    m.friction /= 1 + m.drag * m.time_step; // the probe's motion knows no other drag
  m.gamma = scene.probe.gamma;
  m.beta = scene.probe.beta;
  m.acceleration_memory = scene.probe.acceleration_memory;
  m.energy_of_all_springs = scene.probe.energy_springs == "all";
  m.force_on_acceleration = scene.probe.force_on == "acceleration";
  for (std::size_t x = 0; x < 3; ++x)
    m.force[x] = scene.force.gravity[x] + (scene.force.wind ? (*scene.force.wind)[x] : 0.0);
  m.threshold = scene.relax.threshold;
  m.max_sweeps = static_cast<std::uint32_t>(scene.relax.max_sweeps);
  m.expansions = static_cast<std::uint32_t>(scene.relax.expansions);
  return m;
}

ArrayMotion::ArrayMotion(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array,
                         ArrayPort& port, bool check)
    : mesh_(mesh), port_(port), profile_(port.bus(), array), motion_(motion_of(scene)), memory_(mesh),
      buffer_(4096) {
  if (check) check_.emplace(scene, mesh, array.schedule);
}

// The array is looked at with the first step, when every port of the process has been made.
void ArrayMotion::open() {
  const int error = hm_driver_open(&driver_, &profile_.bus(), &mesh_.firmware(), buffer_.data(),
                                   static_cast<std::uint32_t>(buffer_.size()));
  if (error != HM_OK) throw std::runtime_error(error_text(error));
}

StepRow ArrayMotion::advance() {
  if (!driver_.bus) open();
  const std::uint64_t step = memory_.state.step, bus_before = bus_cycles();
  rest_ = memory_.output;
  if (check_) check_->begin(state());
  port_.begin_step(step);
  const hm_solver solver{&driver_, hm_driver_relax};
  hm_step_result result;
  const int error = hm_step(&mesh_.firmware(), &motion_, &solver, &memory_.state, &result);
  if (error == HM_ERROR_STOPPED) {
    std::copy(rest_.begin(), rest_.end(), memory_.output.begin());
    throw Stopped();
  }
  if (error == HM_ERROR_NUMBER) throw Diverged(error_text(error));
  if (error != HM_OK && error != HM_ERROR_LOST) throw std::runtime_error(error_text(error));
  port_.end_step(step);
  if (error == HM_ERROR_LOST)
    throw Diverged("node " + std::to_string(result.lost_node) + " has no finite position");

  StepRow row;
  row.step = step;
  row.time = static_cast<double>(memory_.state.step) * motion_.time_step;
  row.sweeps = result.sweeps;
  row.cycles = result.cycles;
  row.converged = result.converged;
  row.clipped = driver_.clipped;
  row.bus_cycles = bus_cycles() - bus_before;
  row.saturated = static_cast<std::uint64_t>(std::count_if(memory_.output.begin(), memory_.output.end(),
                                                           [](double V) { return std::fabs(V) >= 1; }));
  measure(mesh_.mesh(), memory_.position.data(), memory_.velocity.data(), row);
  if (check_) {
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    row.error = check_->judge(memory_.state.network, memory_.start, memory_.state.scale);
    judging_seconds_ += std::chrono::duration<double>(Clock::now() - began).count();
  }
  row.hash = hash();
  return row;
}

// As state_hash(state()), without the copy of large meshes.
std::uint64_t ArrayMotion::hash() const {
  const std::vector<double> none;
  const bool two_steps = motion_.rule == HM_BDF2;
  return state_hash({&memory_.position, &memory_.velocity, &memory_.acceleration, &memory_.output,
                     two_steps ? &memory_.previous_position : &none,
                     two_steps ? &memory_.previous_velocity : &none});
}

std::uint64_t ArrayMotion::bus_cycles() const {
  const hm_bus& bus = port_.bus();
  std::uint32_t low = 0, high = 0;
  bus.read(bus.context, HM_REG_BUS_CYCLES_LO, &low);
  bus.read(bus.context, HM_REG_BUS_CYCLES_HI, &high);
  return std::uint64_t{high} << 32 | low;
}

// Exact: V is a multiple of the state's last place.
std::vector<std::int32_t> ArrayMotion::raw(const std::vector<double>& outputs) const {
  std::vector<std::int32_t> codes(outputs.size());
  hm_codes(outputs.data(), static_cast<std::uint32_t>(outputs.size()),
           hm_power_of_two(hm_fraction_bits(&driver_.state)), &driver_.state,
           reinterpret_cast<std::uint32_t*>(codes.data()));
  return codes;
}

std::vector<SignalRange> ArrayMotion::ranges() const {
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

StepState ArrayMotion::state() const {
  StepState s{
      memory_.state.step, memory_.position, memory_.velocity, memory_.acceleration, memory_.output, {}, {}};
  if (motion_.rule == HM_BDF2)
    s.previous_position = memory_.previous_position, s.previous_velocity = memory_.previous_velocity;
  return s;
}

// Values are copied into place: the firmware's pointers stay what they are.
void ArrayMotion::restore(const StepState& state, const std::vector<SignalRange>& seen) {
  memory_.state.step = state.step;
  const auto copy = [](const std::vector<double>& from, std::vector<double>& to) {
    if (from.size() != to.size()) throw std::logic_error("the state of another mesh");
    std::copy(from.begin(), from.end(), to.begin());
  };
  copy(state.position, memory_.position);
  copy(state.velocity, memory_.velocity);
  copy(state.acceleration, memory_.acceleration);
  copy(state.output, memory_.output);
  if (motion_.rule == HM_BDF2) {
    copy(state.previous_position, memory_.previous_position);
    copy(state.previous_velocity, memory_.previous_velocity);
  }
  seen_ = seen;
}

} // namespace hopmesh::study
