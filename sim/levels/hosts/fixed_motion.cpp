#include "sim/levels/hosts/fixed_motion.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hopmesh::levels {

namespace {

constexpr double room = 2.5;               // a mesh may grow, or move, by so many of its extents
constexpr double most_position = 0x1.cp30; // of a word, as fixed.c has it
constexpr int most_component = 29;         // places of a spring's component: three squares are below 2^62

/// mantissa * 2^(exponent - 31).
struct Scaled {
  std::int32_t mantissa = 0, exponent = 0;
};
Scaled scaled(double value) {
  if (value == 0) return {};
  int exponent = 0;
  double mantissa = std::round(std::ldexp(std::frexp(value, &exponent), 31));
  if (mantissa >= 0x1p31) mantissa /= 2, ++exponent;
  return {static_cast<std::int32_t>(mantissa), exponent};
}

/// The exponent of the least power of two that is no less.
int power_above(double value) {
  int exponent = 0;
  return std::frexp(value, &exponent) == 0.5 ? exponent - 1 : exponent;
}

std::int32_t in_places(double value, int places) {
  const double counted = std::round(std::ldexp(value, places));
  return static_cast<std::int32_t>(std::max(-0x1p31, std::min(counted, 0x1p31 - 1)));
}

double stiffest(const hm_mesh& mesh) {
  double most = 0;
  for (std::uint32_t e = 0; e < mesh.springs; ++e) most = std::max(most, mesh.spring[e].weight);
  return most;
}

} // namespace

FixedMotion::FixedMotion(const HostPlace& place) : place_(place) {
  const hm_mesh& mesh = place.mesh;
  plan_.implicit = place.motion.formulation != &hm_probe;
  plan_.nodes = mesh.nodes, plan_.springs = mesh.springs, plan_.cells = mesh.cells;
  plan_.weights = hm_weight_count(&mesh);
  plan_.max_sweeps = place.motion.max_sweeps;
  choose_places();
  choose_units();
  add_springs();
  add_nodes();
  set_motion();
  for (auto* values : {&position, &way, &predicted}) values->assign(3 * mesh.nodes, 0);
  for (auto* values : {&change, &output, &start, &direction}) values->assign(3 * mesh.cells, 0);
  next.assign(6 * mesh.cells, 0), kick.assign(mesh.cells, 0);
  weight.assign(plan_.weights, 0);
  bias.assign(3 * mesh.cells, 0), energy.assign(mesh.cells, 0);
  state_ = {position.data(),
            way.data(),
            predicted.data(),
            change.data(),
            output.data(),
            start.data(),
            direction.data(),
            next.data(),
            weight.data(),
            bias.data(),
            energy.data(),
            kick.data(),
            0,
            0,
            0,
            0};
}

// Positions fill a word; springs have a range of their own.
void FixedMotion::choose_places() {
  const hm_mesh& mesh = place_.mesh;
  const std::vector<double>& x = place_.memory.now.position;
  double extent = 0, longest = 0;
  for (const double at : x) extent = std::max(extent, std::fabs(at));
  for (std::uint32_t e = 0; e < mesh.springs; ++e) {
    const hm_spring& s = mesh.spring[e];
    double square = 0;
    for (std::size_t p = 0; p < 3; ++p) {
      const double away = x[3 * s.node[0] + p] - x[3 * s.node[1] + p];
      square += away * away;
    }
    longest = std::max({longest, s.rest_length, std::sqrt(square)});
  }
  extent = std::max(extent, longest);
  plan_.spring_places = most_component - power_above(room * longest);
  plan_.position_places =
      std::min(static_cast<int>(std::floor(std::log2(most_position / (room * extent)))), plan_.spring_places);
  plan_.longest = std::int32_t{1} << (most_component - (plan_.spring_places - plan_.position_places));
}

void FixedMotion::choose_units() {
  const hm_step_parameters& m = place_.motion;
  const double dt = m.time_step, h = dt * dt / 2, most = stiffest(place_.mesh);
  double unit = 2 * most * h * h;
  if (plan_.implicit) unit = std::max(unit, m.mass * (1 + m.drag * dt) / (dt * dt) * h * h);
  for (std::uint32_t c = 0; c < place_.mesh.cells && !plan_.implicit; ++c)
    unit =
        std::max(unit, 2 * m.beta * dt * dt * dt * dt * place_.mesh.beta_weight[place_.mesh.node_of_cell[c]]);
  plan_.unit_exponent = power_above(unit);
  plan_.pull_exponent = power_above(2 * most * h / std::ldexp(1, plan_.unit_exponent));
  const Scaled of_h = scaled(h);
  plan_.h = of_h.mantissa, plan_.h_exponent = of_h.exponent;
  plan_.most_scale = 27 - plan_.spring_places - plan_.h_exponent;
  plan_.least_scale = std::max(-2 - plan_.spring_places - plan_.h_exponent,
                               plan_.pull_exponent - HM_FIXED_PULL - plan_.spring_places);
}

double FixedMotion::unit() const {
  return std::ldexp(1, plan_.unit_exponent);
}

void FixedMotion::add_springs() {
  const hm_mesh& mesh = place_.mesh;
  const double dt = place_.motion.time_step, h = dt * dt / 2;
  const int largest = power_above(stiffest(mesh));
  const auto place_of = [&](std::uint32_t cell, std::uint32_t link) {
    const std::uint32_t own = hm_row_offset(&mesh, cell, 0);
    return link == HM_PINNED ? own : own + 3 * (1 + link - mesh.first_link[cell]);
  };
  for (std::uint32_t e = 0; e < mesh.springs; ++e) {
    const hm_spring& from = mesh.spring[e];
    hm_fixed_spring s{};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t node = from.node[k], cell = mesh.cell_of_node[node], link = from.link[k];
      if (cell == HM_PINNED)
        s.end[k] = {node, cell, 0, HM_PINNED, 0};
      else
        s.end[k] = {node, cell, place_of(cell, HM_PINNED), link == HM_PINNED ? link : place_of(cell, link),
                    hm_row_length(&mesh, cell)};
    }
    s.rest = in_places(from.rest_length, plan_.spring_places);
    s.stiffness = in_places(2 * from.weight * h * h / unit(), 30);
    s.pull = in_places(2 * from.weight * h / unit(), HM_FIXED_PULL - plan_.pull_exponent);
    s.energy = in_places(from.weight, 17 - largest);
    springs_.push_back(s);
  }
}

void FixedMotion::add_nodes() {
  const hm_mesh& mesh = place_.mesh;
  const hm_step_parameters& m = place_.motion;
  const double dt = m.time_step, h = dt * dt / 2;
  for (std::uint32_t c = 0; c < mesh.cells; ++c) {
    const double own = plan_.implicit
                           ? m.mass * (1 + m.drag * dt) / (dt * dt) * h * h
                           : 2 * m.beta * dt * dt * dt * dt * mesh.beta_weight[mesh.node_of_cell[c]];
    nodes_.push_back({mesh.node_of_cell[c], hm_row_offset(&mesh, c, 0), hm_row_length(&mesh, c),
                      in_places(own / unit(), HM_FIXED_WEIGHT)});
  }
}

void FixedMotion::set_motion() {
  const hm_step_parameters& m = place_.motion;
  const double dt = m.time_step, slowed = 1 + m.drag * dt;
  const int way_places = plan_.position_places + HM_FIXED_FINER;
  plan_.kept = in_places(plan_.implicit ? m.friction : m.friction / slowed, 30);
  plan_.slowed = in_places(1 / slowed, 30);
  const double of_force = plan_.implicit ? dt * dt / slowed : m.force_on_acceleration ? 0 : dt * dt;
  for (std::size_t p = 0; p < 3; ++p) plan_.fall[p] = in_places(of_force * m.force[p], way_places);
  const double alpha = std::ldexp(1, power_above(stiffest(place_.mesh)));
  const Scaled gain = scaled(std::sqrt(m.gamma * alpha) * dt * dt);
  plan_.gain = gain.mantissa, plan_.gain_exponent = gain.exponent;
}

void FixedMotion::set_threshold(const hm_driver& driver) {
  plan_.threshold = static_cast<std::uint32_t>(
      std::min(std::floor(std::ldexp(place_.motion.threshold, hm_fraction_bits(&driver.state))), 0x1p31 - 1));
}

void FixedMotion::take() {
  const StepState& now = place_.memory.now;
  const double dt = place_.motion.time_step;
  const int way_places = plan_.position_places + HM_FIXED_FINER;
  for (std::size_t k = 0; k < position.size(); ++k) {
    position[k] = in_places(now.position[k], plan_.position_places);
    way[k] = in_places(now.velocity[k] * dt, way_places);
  }
  for (std::size_t k = 0; k < output.size(); ++k) output[k] = in_places(now.output[k], HM_FIXED_OUTPUT);
  double largest = 0;
  for (const double a : now.acceleration) largest = std::max(largest, std::fabs(a));
  state_.change_exponent = largest > 0 ? power_above(largest) : 0;
  for (std::size_t k = 0; k < change.size(); ++k)
    change[k] = in_places(now.acceleration[3 * place_.mesh.node_of_cell[k / 3] + k % 3],
                          HM_FIXED_OUTPUT - state_.change_exponent);
  state_.step = static_cast<std::uint32_t>(place_.memory.state.step);
}

// Forces of the probe's accelerations are doubles that nobody computes with.
void FixedMotion::give() {
  StepMemory& memory = place_.memory;
  const hm_step_parameters& m = place_.motion;
  const double dt = m.time_step;
  const int places = plan_.position_places, unit_places = plan_.unit_exponent + 2 * state_.scale_exponent;
  for (std::size_t k = 0; k < position.size(); ++k) {
    memory.now.position[k] = std::ldexp(position[k], -places);
    memory.now.velocity[k] = std::ldexp(way[k], -places - HM_FIXED_FINER) / dt;
    memory.predicted[k] = std::ldexp(predicted[k], -places);
  }
  for (std::size_t k = 0; k < output.size(); ++k) {
    const std::size_t cell = k / 3, at = 3 * place_.mesh.node_of_cell[cell] + k % 3;
    memory.now.output[k] = std::ldexp(output[k], -HM_FIXED_OUTPUT);
    memory.start[k] = std::ldexp(start[k], -HM_FIXED_OUTPUT);
    memory.bias[k] = std::ldexp(static_cast<double>(bias[k]), unit_places - state_.bias_places);
    memory.direction[k] = std::ldexp(direction[k], -HM_FIXED_OUTPUT);
    memory.now.acceleration[at] =
        plan_.implicit ? std::ldexp(output[k], state_.scale_exponent - HM_FIXED_OUTPUT)
                       : memory.direction[k] * std::ldexp(kick[cell], -places - HM_FIXED_FINER) / (dt * dt) +
                             (m.force_on_acceleration ? m.force[k % 3] : 0);
  }
  for (std::size_t k = 0; k < weight.size(); ++k)
    memory.weight[k] = std::ldexp(weight[k], unit_places - HM_FIXED_WEIGHT);
  const int energy_places = HM_FIXED_ENERGY - power_above(stiffest(place_.mesh));
  for (std::size_t c = 0; c < energy.size(); ++c)
    memory.energy_change[c] = std::ldexp(static_cast<double>(energy[c]), -energy_places);
  memory.state.scale = std::ldexp(1, state_.scale_exponent);
  memory.state.step = state_.step;
}

Refusal why_not_fixed(const scene::Scene& scene, const spec::ArraySpec& array, const HostPlace& place) {
  using scene::EnergySprings;
  const bool probe = scene.motion.formulation == scene::Formulation::probe;
  if (scene.mesh.planar) return {"mesh.planar", "true", "false"};
  if (scene.mesh.law != scene::SpringLaw::linear) return {"mesh.springs.law", "\"tension\"", "\"linear\""};
  if (!probe && scene.incremental.rule != scene::Rule::backward_euler)
    return {"incremental.rule", "another rule", "\"backward_euler\""};
  if (probe && scene.probe.acceleration_memory != 0) return {"probe.acceleration_memory", "a memory", "0"};
  if (probe && scene.probe.energy_springs == EnergySprings::all)
    return {"probe.energy_springs", "\"all\"", "\"own\""};
  if (scene.force.image) return {"force.image", "a picture", "none"};
  if (scene.relax.expansions > 1) return {"relax.expansions", "more than one", "1"};
  if (scene.relax.corrects()) return {"relax.refinements", "corrections", "none"};
  if (scene.relax.stop == scene::Stop::sum) return {"relax.stop", "\"sum\"", "\"change\""};
  if (array.output == spec::Output::modified && array.normaliser == spec::Normaliser::prescaled)
    return {"array.normaliser", "\"prescaled\"", "another one"};
  if (array.formats.state.fraction_bits() > HM_FIXED_OUTPUT || array.formats.state.fraction_bits() < 1 ||
      array.formats.state.integer_bits > 2)
    return {"array.state", "a format", "at most 2 bits before the point, and 1 to 29 behind it"};
  const FixedMotion motion(place);
  if (motion.plan().least_scale > 0 || motion.plan().most_scale < 0 || motion.plan().spring_places > 40)
    return {"motion.time_step", "a step that moves springs out of the range", "another one"};
  return {};
}

} // namespace hopmesh::levels
