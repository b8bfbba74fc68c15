// All that the next step of a motion depends on: what is hashed after each step, and what a checkpoint keeps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hopmesh::study {

/// Bit for bit; a motion that is given it back goes on as if nothing had happened.
struct StepState {
  std::uint64_t step = 0;                               ///< steps done
  std::vector<double> position, velocity, acceleration; ///< [nodes * 3]
  std::vector<double> output; ///< V at rest: [cells * components], at level reference [nodes * components]
};

/// XXH64 of more values behind those that gave `before`.
std::uint64_t hash_on(std::uint64_t before, const double* values, std::size_t count);

/// The column `hash` of steps.csv; vectors of any kind.
template <class Values>
std::uint64_t state_hash(const Values& position, const Values& velocity, const Values& acceleration,
                         const Values& output) {
  std::uint64_t hash = 0;
  for (const Values* values : {&position, &velocity, &acceleration, &output})
    hash = hash_on(hash, values->data(), static_cast<std::size_t>(values->size()));
  return hash;
}

} // namespace hopmesh::study
