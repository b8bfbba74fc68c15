// Random places to start from, the same on every machine: the generator and its rounding are our own.
#include "sim/scene/mesh_parts.h"

namespace hopmesh::scene {

namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the k-th number of a seed, whatever was asked before.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t k) {
  std::uint64_t z = seed + (k + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

/// From -1 to 1, in steps of 2^-52: exact.
double random_share(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

} // namespace

// Numbers belong to places, not to a sequence: another pin leaves all other nodes where they were.
void shuffle_nodes(const Start& start, Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (std::size_t p = 0; p < 3; ++p) {
      if (mesh.pinned[i] || (mesh.planar && p == 1)) continue;
      const std::uint64_t bits = random_bits(static_cast<std::uint64_t>(start.seed), 3 * i + p);
      mesh.position[i][p] += start.shuffle * random_share(bits);
    }
}

} // namespace hopmesh::scene
