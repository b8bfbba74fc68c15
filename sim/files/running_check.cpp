#include "sim/files/running_check.h"

#include <new>
#include <xxhash.h>

namespace hopmesh::files {

RunningCheck::RunningCheck() : state_(XXH64_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH64_reset(state_.get(), 0);
}

void RunningCheck::Free::operator()(XXH64_state_s* state) const {
  XXH64_freeState(state);
}

void RunningCheck::add(const void* data, std::size_t bytes) {
  XXH64_update(state_.get(), data, bytes);
}

std::uint64_t RunningCheck::value() const {
  return XXH64_digest(state_.get());
}

} // namespace hopmesh::files
