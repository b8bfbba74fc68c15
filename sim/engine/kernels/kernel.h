// What the fast core hands to its kernels, and the kernels that there are. A kernel fires blocks of sixteen
// cells whose weights and links have at most 16 bits; the same source (kernel_body.h) is compiled for several
// instruction sets, and the processor at hand decides at run time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace hopmesh::engine {

/// Where sixteen lanes find a neighbour's outputs: side by side from `base` on; at most 31 slots from `base`
/// (`lane`); or anywhere (`base` counts in KernelArgs::far_slot).
struct Source {
  enum Kind : std::uint32_t { together, near, far };
  std::uint32_t base;
  Kind kind;
  std::uint8_t lane[16];
};

/// x * 2^-places rounded: add, plus what a negative x and an odd result get, then a floor.
struct KernelRounding {
  std::int64_t add = 0, add_if_negative = 0, add_if_odd = 0;
  int places = 0;
  bool plain() const { return add_if_negative == 0 && add_if_odd == 0; }
};

/// A quotient as a floor of doubles: the sign is turned (flip) before and after, and `half` added between.
struct KernelDivision {
  std::int64_t flip_by_sign = 0, flip_always = 0; ///< 0 or -1
  double half = 0;
  int ratio_up = 0;
};

struct KernelArgs {
  const std::uint32_t* neighbours;   ///< of a block; even where a cell has one neuron or three
  const std::size_t* first_weight;   ///< of a block, in `weight`
  const std::uint32_t* first_source; ///< of a block, in `source`
  const Source* source;
  const std::uint8_t* waits; ///< does a block read one of the two before it? (not within a group)
  const std::uint32_t* far_slot;
  /// Pairs of 16-bit codes in sixteen lanes, in the order in which a kernel reads them. Three neurons a cell:
  /// x and y of one neighbour, x and y of the next, z of both, and so on; then own z beside a zero; then own
  /// x and y. Two: x and y of each neighbour, then own. Each pair first for neuron 0, then for 1, then for 2.
  /// One: x of one neighbour, x of the next, and so on; then own x beside a zero.
  const std::uint32_t* weight;
  const std::int32_t* bias;       ///< [block][p][lane], and so all below
  const std::int64_t* multiplier; ///< reciprocal, all with one point; or 1 / N as a double's bits
  std::int32_t* state;
  /// Links by slot: x and y in one word; z in both halves of another, or x where it is alone.
  const std::uint32_t *xy, *zz;
  std::uint32_t *next_xy, *next_zz; ///< the same, but in synchronous arrays
  bool synchronous;
  int bias_up, state_fraction;
  std::int64_t one_drive;
  KernelRounding drive, state_rounding, link;
  KernelDivision division;
};

/// Running extremes, lane by lane; the kernel widens them. |Delta V| is unsigned: it may be 2^31.
struct alignas(64) KernelSwings {
  std::uint32_t largest_change[16] = {};
  std::int64_t least_sum[8] = {}, largest_sum[8] = {}, least_drive[8] = {}, largest_drive[8] = {};
};

using FireKernel = void (*)(const KernelArgs& args, std::size_t first, std::size_t last,
                            KernelSwings& swings);
/// Sum of |weight| of every row of a block: [p][lane].
using RowKernel = void (*)(const KernelArgs& args, std::size_t block, std::uint32_t* sums);

enum class Normalise : std::uint8_t { multiply, scale, divide, sign };

/// All kernels of one instruction set: [neurons a cell - 1][Normalise][plain rounding][wide sums].
struct KernelSet {
  const char* name;
  FireKernel fire[3][4][2][2];
  RowKernel rows[3];
};

extern const KernelSet portable_kernels;
#ifdef HOPMESH_X86_KERNELS
extern const KernelSet avx2_kernels, avx512_kernels;
#endif

} // namespace hopmesh::engine
