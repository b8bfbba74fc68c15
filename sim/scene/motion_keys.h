// [motion], [probe], [incremental] and [rival] of a scene file: their values, and a row for each
// key.
#pragma once

#include "sim/input/key_table.h"
#include "sim/scene/limits.h"
#include "sim/scene/relax_keys.h"

namespace hopmesh::scene {

enum class Formulation : std::uint8_t { probe, incremental };
inline constexpr std::array<std::string_view, 2> formulation_names{"probe", "incremental"};

struct MotionKeys {
  Formulation formulation = Formulation::probe;
  double time_step = 0.05;
  std::int64_t steps = 400;
  double friction = 0.99;
};

enum class EnergySprings : std::uint8_t { own, all };
inline constexpr std::array<std::string_view, 2> energy_springs_names{"own", "all"};

enum class ForceOn : std::uint8_t { velocity, acceleration };
inline constexpr std::array<std::string_view, 2> force_on_names{"velocity", "acceleration"};

struct ProbeSpec {
  double gamma = 4000.0;
  double beta = 1.0;
  double acceleration_memory = 0.0;
  EnergySprings energy_springs = EnergySprings::own;
  ForceOn force_on = ForceOn::velocity;
};

enum class Rule : std::uint8_t { backward_euler, bdf2, statics };
inline constexpr std::array<std::string_view, 3> rule_names{"backward_euler", "bdf2", "static"};

inline std::string name_of(Rule rule) {
  return std::string(rule_names[static_cast<std::size_t>(rule)]);
}

struct IncrementalSpec {
  Rule rule = Rule::backward_euler;
};

struct RivalSpec {
  double tolerance = 0;
};

/// Whether anything has a speed; in the static rule nothing does.
inline input::When moving(const MotionKeys& m, const IncrementalSpec& i) {
  return {m.formulation == Formulation::probe || i.rule != Rule::statics,
          "a motion through time, not incremental.rule = \"static\""};
}

/// In the order of scene files.
inline input::Keys motion_keys(MotionKeys& m, ProbeSpec& p, IncrementalSpec& i, RelaxSpec& r, RivalSpec& v) {
  using namespace input;
  const When probe{m.formulation == Formulation::probe, "motion.formulation = \"probe\""};
  const When incremental{m.formulation == Formulation::incremental, "motion.formulation = \"incremental\""};
  const Range count{1, most_count, ""};
  Keys keys{
      Key("motion.formulation", spec::choice(m.formulation, formulation_names),
          "what outputs mean: directions (the paper), or accelerations of an implicit step"),
      Key("motion.time_step", &m.time_step, above_zero, "Δt").in_unit("s"),
      Key("motion.steps", &m.steps, count, "how many"),
      Key("motion.friction", &m.friction, zero_to_one,
          "what a step leaves of a velocity, whatever its length")
          .counts(moving(m, i))
          .leaves_out(1, "friction", "a factor of 1: none"),
      Key("probe.gamma", &p.gamma, from_zero, "γ: how hard a probed energy kicks").counts(probe),
      Key("probe.beta", &p.beta, from_zero,
          "pull of V towards unit length: β of node i is `beta` · Δt⁴ · mean α of its springs")
          .counts(probe)
          .leaves_out(0, "unit-length term", "beta 0: outputs of any length"),
      Key("probe.acceleration_memory", &p.acceleration_memory, zero_to_one,
          "how much of a step's acceleration the next one keeps; 1.0: the paper's equation 7 as printed")
          .counts(probe)
          .leaves_out(0, "acceleration before", "memory 0: each step probes anew"),
      Key("probe.energy_springs", spec::choice(p.energy_springs, energy_springs_names),
          "springs that a node's probed energy counts: its own, or all")
          .counts(probe),
      Key("probe.force_on", spec::choice(p.force_on, force_on_names),
          "what gravity and wind are added to, each step")
          .counts(probe),
      Key("incremental.rule", spec::choice(i.rule, rule_names),
          "the implicit step of `formulation = \"incremental\"`; `\"static\"`: a step towards rest, without "
          "speed or inertia")
          .counts(incremental),
  };
  for (const Key& key : relax_keys(r, incremental)) keys.push_back(key);
  keys.push_back(
      Key("rival.tolerance", &v.tolerance, from_zero,
          "levels that are implicit integrators end a step with the iteration that moves no coordinate by "
          "more; 0: as each of them does by itself")
          .in_unit("m"));
  return keys;
}

} // namespace hopmesh::scene
