// All that the next step of a motion depends on: what is hashed after each step, and what a checkpoint keeps.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace hopmesh::levels {

/// Bit for bit; a motion that is given it back goes on as if nothing had happened.
struct StepState {
  std::uint64_t step = 0;                               ///< steps done
  std::vector<double> position, velocity, acceleration; ///< [nodes * 3]
  std::vector<double> output; ///< V at rest: [cells * components], at level reference [nodes * components]
  std::vector<double> previous_position,
      previous_velocity; ///< a step before; of methods that look back, else empty
  /// Of arrays whose answers are corrected, else empty: what hm_kept holds, the shift of the weights that the
  /// array has, and these weights where a step may go on with them.
  std::vector<double> kept;
};

/// The arrays of a state in their order, each with its name.
template <class State> auto parts_of(State& state) {
  return std::array{std::pair("position", &state.position),
                    std::pair("velocity", &state.velocity),
                    std::pair("acceleration", &state.acceleration),
                    std::pair("output", &state.output),
                    std::pair("previous_position", &state.previous_position),
                    std::pair("previous_velocity", &state.previous_velocity),
                    std::pair("kept", &state.kept)};
}

/// XXH64 of more values behind those that gave `before`.
std::uint64_t hash_on(std::uint64_t before, const double* values, std::size_t count);

/// The column `hash` of steps.csv: of these arrays in the order of parts_of, empty ones left out.
std::uint64_t state_hash(const StepState& state);

} // namespace hopmesh::levels
