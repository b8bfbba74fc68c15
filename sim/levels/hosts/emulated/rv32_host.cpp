#include "sim/levels/hosts/emulated/rv32_host.h"

#include "firmware/registers.h"
#include "sim/levels/array_port.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace hopmesh::levels {

/// Made during the build: hopmesh_embed of CMakeLists.txt.
const std::vector<std::pair<std::string, std::string>>& core_programs();

namespace {

const std::string& program_for(const std::string& core) {
  for (const auto& [file, elf] : core_programs())
    if (file == core + ".elf") return elf;
  throw std::logic_error("no program for " + core);
}

} // namespace

// What core and loader both read has no pointers, and the layout of 32 bits.
static_assert(sizeof(hm_spring) == 32 && offsetof(hm_spring, weight) == 8 && offsetof(hm_spring, link) == 24);
static_assert(sizeof(hm_core_mesh) == 64 && offsetof(hm_core_job, answer) % 8 == 0);

Rv32Host::Rv32Host(const scene::HostSpec& host, const HostPlace& place)
    : place_(place), program_(program_for(name_of(host.core))), core_(program_, place.bus),
      job_(core_.reserve(sizeof(hm_core_job))) {
  put_mesh();
  put_motion();
  if (host.arithmetic == scene::Arithmetic::fixed)
    put_fixed();
  else
    put_state();
  hm_core_job& j = job();
  j.buffer_words = static_cast<std::uint32_t>(longest_burst);
  j.buffer = core_.reserve(4 * longest_burst);
  j.bus_master = host.dma;
}

template <typename T> std::uint32_t Rv32Host::put(const T* values, std::size_t count) {
  const std::uint32_t address = core_.reserve(sizeof(T) * count);
  std::copy(values, values + count, core_.at<T>(address));
  return address;
}

std::uint32_t Rv32Host::share(std::vector<double>& values, bool goes_in) {
  if (values.empty()) return 0;
  shared_.push_back({&values, core_.reserve(sizeof(double) * values.size()), goes_in});
  return shared_.back().address;
}

void Rv32Host::put_mesh() {
  const hm_mesh& from = place_.mesh;
  hm_core_mesh m{};
  m.nodes = from.nodes, m.springs = from.springs, m.cells = from.cells, m.components = from.components;
  std::copy(from.axis, from.axis + 3, m.axis);
  m.law = from.law, m.floor = from.floor;
  m.spring = put(from.spring, from.springs);
  m.beta_weight = put(from.beta_weight, from.nodes);
  m.cell_of_node = put(from.cell_of_node, from.nodes);
  m.node_of_cell = put(from.node_of_cell, from.cells);
  m.first_link = put(from.first_link, from.cells + 1);
  m.link_to = put(from.link_to, from.first_link[from.cells]);
  job().mesh = m;
}

void Rv32Host::put_motion() {
  const hm_step_parameters& from = place_.motion;
  const scene::RelaxSpec& relax = place_.relax;
  hm_core_motion m{};
  m.time_step = from.time_step, m.friction = from.friction, m.mass = from.mass, m.drag = from.drag;
  m.gamma = from.gamma, m.beta = from.beta, m.acceleration_memory = from.acceleration_memory;
  std::copy(from.force, from.force + 3, m.force);
  m.threshold = from.threshold, m.max_sweeps = from.max_sweeps;
  m.expansions = from.expansions, m.refinements = from.refinements;
  m.by_sum = relax.stop == scene::Stop::sum;
  m.share = m.by_sum ? relax.share : 0;
  m.formulation = static_cast<std::uint32_t>(
      std::find(std::begin(hm_formulations), std::end(hm_formulations), from.formulation) -
      std::begin(hm_formulations));
  m.energy_of_all_springs = static_cast<std::uint32_t>(from.energy_of_all_springs);
  m.force_on_acceleration = static_cast<std::uint32_t>(from.force_on_acceleration);
  m.momentum_count = static_cast<std::uint32_t>(relax.momentum.size());
  m.momentum = m.momentum_count > 0 ? put(relax.momentum.data(), relax.momentum.size()) : 0;
  node_force_ = core_.reserve(sizeof(double) * 3 * place_.mesh.nodes);
  job().motion = m;
}

void Rv32Host::put_state() {
  StepMemory& memory = place_.memory;
  hm_core_state s{};
  s.position = share(memory.now.position, true);
  s.velocity = share(memory.now.velocity, true);
  s.acceleration = share(memory.now.acceleration, true);
  s.previous_position = share(memory.now.previous_position, true);
  s.previous_velocity = share(memory.now.previous_velocity, true);
  s.output = share(memory.now.output, true);
  s.predicted = share(memory.predicted, false);
  s.energy_change = share(memory.energy_change, false);
  s.direction = share(memory.direction, false);
  s.start = share(memory.start, false);
  s.weight = share(memory.weight, false);
  s.bias = share(memory.bias, false);
  s.correction = share(memory.correction, false);
  job().state = s;
}

void Rv32Host::put_fixed() {
  FixedMotion& motion = fixed_.emplace(place_);
  hm_core_fixed f{};
  f.plan = motion.plan();
  f.whole = 1;
  f.spring = put(motion.mesh().spring, f.plan.springs);
  f.node = put(motion.mesh().node, f.plan.cells);
  const auto word = [&](std::vector<std::int32_t>& values) {
    words_.push_back({&values, core_.reserve(4 * values.size())});
    return words_.back().address;
  };
  const auto wide = [&](std::vector<std::int64_t>& values) {
    wide_.push_back({&values, core_.reserve(8 * values.size())});
    return wide_.back().address;
  };
  f.position = word(motion.position), f.way = word(motion.way), f.predicted = word(motion.predicted);
  f.change = word(motion.change), f.output = word(motion.output), f.start = word(motion.start);
  f.direction = word(motion.direction), f.next = word(motion.next), f.weight = word(motion.weight);
  f.kick = word(motion.kick), f.bias = wide(motion.bias), f.energy = wide(motion.energy);
  job().fixed = f;
}

void Rv32Host::send_fixed() {
  fixed_->take();
  for (const auto& s : words_)
    std::copy(s.values->begin(), s.values->end(), core_.at<std::int32_t>(s.address));
  hm_core_fixed& f = job().fixed;
  f.change_exponent = fixed_->state().change_exponent;
  f.step = fixed_->state().step;
}

void Rv32Host::fetch_fixed() {
  const auto back = [](auto& all, auto* from) { std::copy(from, from + all.size(), all.begin()); };
  for (const auto& s : words_) back(*s.values, core_.at<std::int32_t>(s.address));
  for (const auto& s : wide_) back(*s.values, core_.at<std::int64_t>(s.address));
  const hm_core_fixed& f = job().fixed;
  hm_fixed_state& state = fixed_->state();
  state.change_exponent = f.change_exponent, state.scale_exponent = f.scale_exponent;
  state.bias_places = f.bias_places, state.step = f.step;
  fixed_->give();
}

void Rv32Host::tell_driver() {
  const hm_core_answer& a = job().answer;
  driver_.version = a.version, driver_.output = a.output;
  driver_.weight = a.weight, driver_.bias = a.bias, driver_.state = a.state;
  driver_.shift = a.shift, driver_.clipped = a.clipped, driver_.vanished = a.vanished;
}

int Rv32Host::open() {
  const int error = core_.call("hm_core_start", job_);
  tell_driver();
  if (fixed_) {
    fixed_->set_threshold(driver_);
    job().fixed.plan = fixed_->plan();
  }
  return error;
}

void Rv32Host::send() {
  for (const Shared& s : shared_)
    if (s.goes_in) std::copy(s.values->begin(), s.values->end(), core_.at<double>(s.address));
  const double* const force = place_.motion.node_force;
  if (force) std::copy(force, force + 3 * place_.mesh.nodes, core_.at<double>(node_force_));
  hm_core_job& j = job();
  j.motion.node_force = force ? node_force_ : 0;
  const hm_state& state = place_.memory.state;
  hm_core_answer& a = j.answer;
  a.step = state.step, a.scale = state.scale;
  a.kept_reach = state.kept.reach, a.kept_inertia = state.kept.inertia;
  a.kept_step = state.kept.step, a.softness = state.kept.softness;
}

// Into the vectors as they lie: the firmware's pointers stay what they are.
void Rv32Host::fetch() {
  for (const Shared& s : shared_)
    std::copy(core_.at<double>(s.address), core_.at<double>(s.address) + s.values->size(), s.values->begin());
  const hm_core_answer& a = job().answer;
  hm_state& state = place_.memory.state;
  state.step = a.step, state.scale = a.scale;
  state.kept = {a.kept_reach, a.kept_inertia, a.kept_step, a.softness};
}

namespace {

hm_relaxation told(const hm_core_relaxation& r) {
  return {r.sweeps, r.converged, r.cycles};
}

} // namespace

int Rv32Host::step(HostStep& step) {
  fixed_ ? send_fixed() : send();
  const std::uint64_t before = core_.counts().all();
  const int error = core_.call("hm_core_step", job_);
  step.instructions = core_.counts().all() - before;
  if (!fixed_)
    fetch();
  else if (error == HM_OK)
    fetch_fixed();
  tell_driver();
  const hm_core_answer& a = job().answer;
  step.result.relaxation = told(a.all);
  step.result.refinement = {a.corrections, a.refused, a.residual};
  step.result.lost_node = a.lost_node;
  step.last = told(a.last);
  const std::size_t kept = std::min<std::size_t>(a.relaxations, HM_CORE_RELAXATIONS);
  step.sweeps.assign(a.sweeps, a.sweeps + kept);
  return error;
}

int Rv32Host::restore(const std::vector<double>&, int) {
  throw std::logic_error("a core's weights do not stay"); // make_host refuses such motions
}

} // namespace hopmesh::levels
