// The inner loops over springs, compiled for several instruction sets; the processor decides at run time. All
// give the same bits: they share every operation and its order (no sum runs across lanes).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hopmesh::rivals {

/// Springs of no length pull nowhere; this only keeps their division finite.
inline constexpr double shortest_spring = 1e-300;

/// At most so many springs that a pass takes at once, so that all of it stays in the first cache.
inline constexpr std::ptrdiff_t block_size = 128;

/// Springs that stand together. In a row, spring s joins node + s and node + s + distance; with distance 0
/// each spring names its nodes itself.
struct Block {
  std::ptrdiff_t count, node, distance;
  const double *stiffness, *rest; ///< [count]
  const std::uint32_t *from, *to; ///< [count]
};

/// Adds what a block pulls with to `force`; both arrays [3 * nodes], component by component.
using Pull = void (*)(const Block& block, std::ptrdiff_t nodes, const double* position, double* force);

/// velocity = kept * velocity + time * (force * inverse_mass + external), all [count].
using Kick = void (*)(std::ptrdiff_t count, double kept, double time, const double* force,
                      const double* inverse_mass, const double* external, double* velocity);

/// Springs about a place: a spring's stiffness is `sideways` in every direction, and u u' more, with u the
/// direction times the root of what it is stiffer along. All [count].
struct Tangents {
  double *sideways, *x, *y, *z;
};

/// Fills the tangents of a block at `position` (L/l at most 1, which leaves no spring a negative direction),
/// and adds each spring to both its nodes in `diagonal`: xx, yy, zz, xy, xz, yz, all [nodes].
using Linearise = void (*)(const Block& block, std::ptrdiff_t nodes, const double* position,
                           const Tangents& tangents, double* diagonal);

/// Adds the block's stiffness times `vector` to `product`; both [3 * nodes], component by component.
using Multiply = void (*)(const Block& block, const Tangents& tangents, std::ptrdiff_t nodes,
                          const double* vector, double* product);

struct ForceKernel {
  const char* name;
  Pull pull;
  Kick kick;
  Linearise linearise;
  Multiply multiply;
};
extern const ForceKernel portable_kernel, avx2_kernel, avx512_kernel;

/// Those this processor runs, the widest last.
std::vector<ForceKernel> force_kernels();

} // namespace hopmesh::rivals
