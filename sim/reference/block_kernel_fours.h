// Four figures at a time, as the loops of block_kernel_body.h take them. Each instruction set has its own.
#pragma once

#include "sim/reference/block_kernel.h"

namespace hopmesh::reference {
namespace {

using Four = double __attribute__((vector_size(32), may_alias));
using FourBits = long long __attribute__((vector_size(32), may_alias));

inline const Four* fours(const Quad* quads) {
  return reinterpret_cast<const Four*>(quads);
}
inline Four* fours(Quad* quads) {
  return reinterpret_cast<Four*>(quads);
}

using Two = double __attribute__((vector_size(16), may_alias));

/// Two figures at each place.
inline Four joined(const double* low, const double* high) {
  return __builtin_shufflevector(*reinterpret_cast<const Two*>(low), *reinterpret_cast<const Two*>(high), 0,
                                 1, 2, 3);
}

inline double total(const Four& sums) {
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

inline Four magnitude(const Four& x) {
  constexpr long long all_but_the_sign = 0x7fffffffffffffff;
  return reinterpret_cast<Four>(reinterpret_cast<FourBits>(x) & all_but_the_sign);
}

/// Rows become columns.
inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  const Four ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab2 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four cd = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd2 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab2, cd2, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab2, cd2, 2, 3, 6, 7);
}

// A block is symmetric. With D its diagonal, A = (xy, yz, zx) beside it and v' = (y, z, x), what it does to
// v = (x, y, z) is D v + A v' + A v turned the other way, which is done once for all blocks.
inline Four turned(const Four& v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}
inline Four turned_back(const Four& v) {
  return __builtin_shufflevector(v, v, 2, 0, 1, 3);
}

} // namespace
} // namespace hopmesh::reference
