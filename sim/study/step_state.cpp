#include "sim/study/step_state.h"

#include <xxhash.h>

namespace hopmesh::study {

std::uint64_t hash_on(std::uint64_t before, const double* values, std::size_t count) {
  return XXH64(values, count * sizeof(double), before);
}

} // namespace hopmesh::study
