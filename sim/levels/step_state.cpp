#include "sim/levels/step_state.h"

#include <xxhash.h>

namespace hopmesh::levels {

std::uint64_t hash_on(std::uint64_t before, const double* values, std::size_t count) {
  return XXH64(values, count * sizeof(double), before);
}

std::uint64_t state_hash(const StepState& state) {
  std::uint64_t hash = 0;
  for (const auto& [name, values] : parts_of(state))
    if (!values->empty()) hash = hash_on(hash, values->data(), values->size());
  return hash;
}

} // namespace hopmesh::levels
