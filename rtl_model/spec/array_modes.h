// The choices of an array, by name: schedule, normaliser, output, stages.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hopmesh::spec {

/// Which neurons fire together, all reading the outputs from before the phase.
enum class Schedule : std::uint8_t {
  coloured,   ///< those of one colour of cells: no two of them are joined
  sequential, ///< one neuron at a time, in number order
  synchronous ///< all at once; the energy may rise
};
inline constexpr std::array<std::string_view, 3> schedule_names{"coloured", "sequential", "synchronous"};

/// How u = s / N is made.
enum class Normaliser : std::uint8_t {
  prescaled,  ///< not in the cell: the host divides each row by its N before it loads it
  reciprocal, ///< s times a truncated reciprocal of N, which each row works out once a run
  divider     ///< an exact quotient, one bit a cycle
};
inline constexpr std::array<std::string_view, 3> normaliser_names{"prescaled", "reciprocal", "divider"};

/// How V follows from s.
enum class Output : std::uint8_t {
  modified,  ///< a step toward the bound that s points to, by s / N
  binary,    ///< that bound at once, the sign of s; a sum of zero leaves V as it is
  projected, ///< omega s / |w_ii| further, held in the box: over-relaxation, one colour or neuron at a time
  momentum   ///< s / N further from a point ahead of V, held in the box; all neurons at once
};
inline constexpr std::array<std::string_view, 4> output_names{"modified", "binary", "projected", "momentum"};

/// Who normalises and moves V where neurons share elements.
enum class Stages : std::uint8_t {
  each, ///< an output stage behind every element, which takes one neuron at a time
  one   ///< a single one behind all of them, a pipeline that takes a neuron every cycle
};
inline constexpr std::array<std::string_view, 2> stages_names{"each", "one"};

inline std::string_view name_of(Schedule s) {
  return schedule_names[static_cast<std::size_t>(s)];
}
inline std::string_view name_of(Normaliser n) {
  return normaliser_names[static_cast<std::size_t>(n)];
}
inline std::string_view name_of(Output o) {
  return output_names[static_cast<std::size_t>(o)];
}
inline std::string_view name_of(Stages s) {
  return stages_names[static_cast<std::size_t>(s)];
}

} // namespace hopmesh::spec
