// A check (XXH64) over bytes that come piece by piece: how a stream proves later that it is still the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

struct XXH64_state_s;

namespace hopmesh::files {

class RunningCheck {
 public:
  RunningCheck();
  void add(const void* data, std::size_t bytes);
  std::uint64_t value() const; ///< of all bytes so far; more may follow

 private:
  struct Free {
    void operator()(XXH64_state_s* state) const;
  };
  std::unique_ptr<XXH64_state_s, Free> state_;
};

} // namespace hopmesh::files
