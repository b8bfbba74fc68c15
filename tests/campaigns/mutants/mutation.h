// Mutants of files: what bad luck, a bad disk or a bad program may make of a good file.
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hopmesh::campaigns {

using Random = std::mt19937_64;
using Seeds = std::vector<std::string>;

/// From 0 to n - 1, the same on every machine; n is above 0.
inline std::size_t below(std::size_t n, Random& random) {
  return static_cast<std::size_t>(random() % n);
}

/// A way of changing bytes. `seeds`: where pieces of other files come from.
struct Change {
  const char* name;
  void (*apply)(std::string& bytes, const Seeds& seeds, Random& random);
};
/// All ways of changing bytes. None makes the bytes more than a few times longer.
const std::vector<Change>& changes();

/// A seed after one change, now and then after some more.
std::string mutant_of(const Seeds& seeds, Random& random);

} // namespace hopmesh::campaigns
