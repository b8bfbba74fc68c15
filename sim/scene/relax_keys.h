// [relax] of a scene file: its values, and a row for each key.
#pragma once

#include "sim/input/key_table.h"
#include "sim/scene/limits.h"

namespace hopmesh::scene {

/// By which measure a relaxation has come to rest.
enum class Stop : std::uint8_t { change, sum };
inline constexpr std::array<std::string_view, 2> stop_names{"change", "sum"};

/// What a step sends of its network where weights may stay.
enum class Reload : std::uint8_t { all, bias };
inline constexpr std::array<std::string_view, 2> reload_names{"all", "bias"};

struct RelaxSpec {
  double threshold = 1e-4;
  std::int64_t max_sweeps = 300;
  std::int64_t expansions = 1;
  Stop stop = Stop::change;
  double share = 0x1p-13;            ///< 0: none
  std::vector<double> momentum = {}; ///< m of each sweep, the last for all that follow; empty: "fista"
  std::int64_t refinements = 0;
  Reload reload = Reload::all;
  std::int64_t reload_every = 4;

  /// Whether steps stand on corrections at all.
  bool corrects() const { return refinements > 0 || reload == Reload::bias; }
};

/// The table of m as the value of a key.
input::Special momentum_list(std::vector<double>& list);

/// `incremental`: where outputs are accelerations of an implicit step.
inline input::Keys relax_keys(RelaxSpec& r, const input::When& incremental) {
  using namespace input;
  const Range count{1, most_count, ""};
  return {
      Key("relax.threshold", &r.threshold, from_zero,
          "a sweep in which no output moves by more is the last one")
          .counts({r.stop == Stop::change, "relax.stop = \"change\""}),
      Key("relax.max_sweeps", &r.max_sweeps, count, "at most so many sweeps a step and expansion"),
      Key("relax.expansions", &r.expansions, {1, 1000, ""},
          "how often a step expands the energy anew about the outputs it came to"),
      Key("relax.stop", spec::choice(r.stop, stop_names),
          "what tells rest: how far outputs move, or the inputs s of neurons that may still move"),
      Key("relax.share", &r.share, {0, 0.5, "a number from 0 to 0.5"},
          "a sweep whose largest s, by magnitude, is at most this share of the first sweep's is the last "
          "one, and so is "
          "one at what a last place of the link is worth; arrays take the power of two at or below")
          .counts({r.stop == Stop::sum, "relax.stop = \"sum\""}),
      Key("relax.momentum", momentum_list(r.momentum),
          "m of `array.output = \"momentum\"`, sweep by sweep; the last one holds on")
          .allows("`\"fista\"`, or a list of numbers from 0 to 1"),
      Key("relax.refinements", &r.refinements, {0, 1000, ""},
          "how often an expansion's answer is corrected by its residual in double; the array gets new "
          "biases, "
          "and keeps its weights")
          .counts({incremental.holds, incremental.beside, Otherwise::nothing_but_zero,
                   "a probe's outputs are directions, which no correction makes truer"}),
      Key("relax.reload", spec::choice(r.reload, reload_names),
          "what a step sends to the array: all of its network, or biases alone beside the weights of a step "
          "before")
          .counts({incremental.holds, incremental.beside, Otherwise::refused}),
      Key("relax.reload_every", &r.reload_every, {1, 1000, ""},
          "steps for which weights stay, if corrections by them do not go astray before")
          .counts({incremental.holds && r.reload == Reload::bias, "relax.reload = \"bias\""}),
  };
}

} // namespace hopmesh::scene
