#include "sim/study/array_motion.h"

#include "firmware/registers.h"

#include <cmath>
#include <xxhash.h>

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
    : mesh_(mesh), port_(port), profile_(port.bus(), array), motion_(motion_of(scene)) {
  if (check) check_.emplace(scene, mesh, array.schedule);
  for (const auto& x : mesh.mesh().position) position_.insert(position_.end(), x.begin(), x.end());
  velocity_.assign(position_.size(), 0.0);
  acceleration_ = predicted_ = velocity_;
  const std::size_t neurons = mesh.cells() * mesh.components();
  energy_change_.assign(mesh.cells(), 0.0);
  start_.assign(neurons, 0.0);
  bias_ = output_ = start_;
  weight_.assign(hm_weight_count(&mesh.firmware()), 0.0);
  buffer_.resize(4096);
  state_ = hm_state{position_.data(),
                    velocity_.data(),
                    acceleration_.data(),
                    predicted_.data(),
                    energy_change_.data(),
                    start_.data(),
                    {weight_.data(), bias_.data(), output_.data()},
                    0};
}

// The array is looked at with the first step, when every port of the process has been made.
void ArrayMotion::open() {
  const int error = hm_driver_open(&driver_, &profile_.bus(), &mesh_.firmware(), buffer_.data(),
                                   static_cast<std::uint32_t>(buffer_.size()));
  if (error != HM_OK) throw std::runtime_error(error_text(error));
}

StepRow ArrayMotion::advance() {
  if (!driver_.bus) open();
  const auto x = position_, v = velocity_, a = acceleration_;
  const std::uint64_t step = state_.step, bus_before = bus_cycles();
  if (check_) check_->begin(x.data(), v.data(), a.data(), output_, step);
  port_.begin_step(step);
  const hm_solver solver{&driver_, hm_driver_relax};
  hm_step_result result;
  const int error = hm_step(&mesh_.firmware(), &motion_, &solver, &state_, &result);
  if (error == HM_ERROR_STOPPED) throw Stopped();
  if (error == HM_ERROR_NUMBER) throw Diverged(error_text(error));
  if (error != HM_OK) throw std::runtime_error(error_text(error));
  port_.end_step(step);
  keep_finite(x, v, a);

  StepRow row;
  row.step = step;
  row.time = static_cast<double>(state_.step) * motion_.time_step;
  row.sweeps = result.sweeps;
  row.cycles = result.cycles;
  row.converged = result.converged;
  row.clipped = driver_.clipped;
  row.bus_cycles = bus_cycles() - bus_before;
  for (double V : output_) row.saturated += std::fabs(V) >= 1;
  measure(mesh_.mesh(), position_.data(), velocity_.data(), row);
  if (check_) row.error = check_->judge(state_.network, start_);
  row.hash = hash();
  return row;
}

void ArrayMotion::keep_finite(const std::vector<double>& x, const std::vector<double>& v,
                              const std::vector<double>& a) {
  for (std::size_t k = 0; k < position_.size(); ++k) {
    if (std::isfinite(position_[k]) && std::isfinite(velocity_[k])) continue;
    position_ = x, velocity_ = v, acceleration_ = a;
    throw Diverged("node " + std::to_string(k / 3) + " has no finite position");
  }
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
  int clipped = 0;
  std::vector<std::int32_t> codes;
  for (double V : outputs) codes.push_back(hm_quantise(V, 0, &driver_.state, &clipped));
  return codes;
}

std::vector<SignalRange> ArrayMotion::ranges() const {
  auto all = profile_.ranges();
  for (const SignalRange& range : port_.inner_ranges()) all.push_back(range);
  return all;
}

std::uint64_t ArrayMotion::hash() const {
  std::uint64_t h = 0;
  for (const auto* values : {&position_, &velocity_, &acceleration_, &output_})
    h = XXH64(values->data(), values->size() * sizeof(double), h);
  return h;
}

} // namespace hopmesh::study
