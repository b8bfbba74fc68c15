// What the fast core hands to its kernels, and the kernels that there are. A kernel fires blocks of sixteen
// cells whose weights and links have at most 16 bits; the same source (kernel_body.h) is compiled for several
// instruction sets, and the processor at hand decides at run time.
#pragma once

#include "sim/engine/kernels/once_args.h"
#include "sim/engine/rounding.h"

namespace hopmesh::engine {

/// Where sixteen lanes find a neighbour's outputs: side by side from `base` on; at most 31 slots from `base`
/// (`lane`); or anywhere (`base` counts in KernelArgs::far_slot).
struct Source {
  enum Kind : std::uint32_t { together, near, far };
  std::uint32_t base;
  Kind kind;
  std::uint8_t lane[16];
};

/// s 2^ratio_up / N rounded, as a floor of doubles: what is added before it to the dividend and to the
/// quotient, always and where the dividend is negative.
struct KernelDivision {
  double to_dividend = 0, to_dividend_if_negative = 0, to_quotient = 0, to_quotient_if_negative = 0;
  int ratio_up = 0;
};

/// Of slim kernels, which know only rounding down and to the nearest: u = floor((s scale + to_dividend)
/// inverse
/// + to_quotient), and only the last where they multiply.
struct KernelQuotient {
  double scale = 1, to_dividend = 0, to_quotient = 0;
};
inline constexpr int slim_places =
    15; ///< behind the point of m; Delta V is multiplied in pieces of so many bits

struct KernelArgs {
  const std::uint32_t* neighbours;   ///< of a block; even where a cell has one neuron or three
  const std::size_t* first_weight;   ///< of a block, in `weight`
  const std::uint32_t* first_source; ///< of a block, in `source`
  const Source* source;
  const std::uint8_t* waits; ///< does a block read one of the two before it? (never within a group)
  const std::uint32_t* far_slot;
  /// Pairs of 16-bit codes in sixteen lanes as a kernel reads them, each pair for neuron 0, then for 1, then
  /// for
  /// 2. Cells of three: x and y of a neighbour, x and y of the next, z of both, and so on; own z beside a
  /// zero; own x and y. Cells of two: x and y of each neighbour, then own. Cells of one: x of a neighbour and
  /// x of the next, and so on; own x beside a zero.
  const std::uint32_t* weight;
  const std::int32_t* bias;       ///< [block][p][lane], and so all below
  const std::int64_t* multiplier; ///< reciprocal, all with one point; or 1 / N as a double's bits
  std::int32_t* state;
  std::int32_t* ahead;          ///< Y, of momentum
  const std::int64_t* most_sum; ///< projected and momentum: s is held within it (`slim`: not looked at)
  /// Links by slot: x and y in one word; z in both halves of another, or x where it is alone.
  const std::uint32_t *xy, *zz;
  std::uint32_t *next_xy,
      *next_zz; ///< where new links go: xy and zz themselves, except in synchronous arrays
  bool synchronous;
  int bias_up, state_fraction;
  std::int64_t one_drive, one_state;
  std::int64_t at_one, at_minus_one; ///< codes of the state from which on a link shows 1, and -1
  ShiftRounding drive, state_rounding, link;
  KernelDivision division;
  // Projected and momentum: u to a step of the state, moved up and then rounded; m times Delta V; the limit
  // of u; what moves a sign beyond that; what s is multiplied by before a division; and m.
  int step_up, beyond_up;
  ShiftRounding step, gained;
  std::int64_t most_drive;
  double gain;
  std::int32_t momentum;
  KernelQuotient slim;
  std::size_t slim_blocks; ///< after so many, sums of Delta V might leave the 32 bits of a slim kernel
  OnceArgs once;
};

using FireKernel = void (*)(const KernelArgs& args, std::size_t first, std::size_t last,
                            LaneExtremes& extremes);
/// Sum of |weight| of every row of a block: [p][lane].
using RowKernel = void (*)(const KernelArgs& args, std::size_t block, std::uint32_t* sums);

/// What a kernel does with s: modified, with each normaliser; binary; projected; momentum.
enum class Normalise : std::uint8_t {
  multiply,
  scale,
  divide,
  sign,
  step_multiply,
  step_divide,
  ahead_multiply,
  ahead_divide
};
constexpr bool is_step(Normalise how) {
  return how == Normalise::step_multiply || how == Normalise::step_divide;
}
constexpr bool is_ahead(Normalise how) {
  return how == Normalise::ahead_multiply || how == Normalise::ahead_divide;
}
constexpr bool divides(Normalise how) {
  return how == Normalise::divide || how == Normalise::step_divide || how == Normalise::ahead_divide;
}

/// Kernels for weights kept once, of momentum: [neurons a cell - 1].
struct OnceKernels {
  FireKernel fire[3][2][2]; ///< [ahead_multiply, ahead_divide][by sum]
  /// Writes the planes of a block that face forward, and its own; and the other half: whether those that face
  /// backward are equal. 0: all weights are equal to what stands, or will stand, for them.
  std::uint32_t (*pack[3])(const KernelArgs& args, const OnceSource& source, std::size_t block);
  std::uint32_t (*compare[3])(const KernelArgs& args, const OnceSource& source, std::size_t block);
  /// Y takes the value of V, and neighbours see it: blocks [first, last), links into `next_link`.
  void (*show[3])(const KernelArgs& args, std::size_t first, std::size_t last);
};

/// All kernels of one instruction set: [neurons a cell - 1][Normalise][by sum][plain rounding][wide sums].
struct KernelSet {
  const char* name;
  bool slim;               ///< are there slim kernels?
  const OnceKernels* once; ///< or null
  FireKernel fire[3][8][2][2][2];
  RowKernel rows[3];
};

extern const KernelSet portable_kernels;
#ifdef HOPMESH_X86_KERNELS
extern const KernelSet avx2_kernels, avx512_kernels;
extern const OnceKernels avx2_once, avx512_once;
#endif

} // namespace hopmesh::engine
