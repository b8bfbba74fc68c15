#include "sim/study/step_state.h"

#include <xxhash.h>

namespace hopmesh::study {

std::uint64_t hash_on(std::uint64_t before, const double* values, std::size_t count) {
  return XXH64(values, count * sizeof(double), before);
}

std::uint64_t state_hash(std::initializer_list<const std::vector<double>*> parts) {
  std::uint64_t hash = 0;
  for (const std::vector<double>* values : parts)
    if (!values->empty()) hash = hash_on(hash, values->data(), values->size());
  return hash;
}

std::uint64_t state_hash(const StepState& s) {
  return state_hash(
      {&s.position, &s.velocity, &s.acceleration, &s.output, &s.previous_position, &s.previous_velocity});
}

} // namespace hopmesh::study
