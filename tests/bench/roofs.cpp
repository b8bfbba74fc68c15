#include "tests/bench/roofs.h"

#include <cstdlib>
#include <immintrin.h>

namespace hopmesh::bench {

#define HM_WIDE __attribute__((target("avx512f,avx512bw,avx512vnni")))

Stream::Stream(std::size_t bytes) : bytes_(bytes / 512 * 512) {
  constexpr std::size_t huge = std::size_t{2} << 20;
  data_ = static_cast<std::int32_t*>(std::aligned_alloc(huge, (bytes_ + huge - 1) / huge * huge));
  for (std::size_t k = 0; k < bytes_ / 4; ++k) data_[k] = static_cast<std::int32_t>(k);
}

Stream::~Stream() {
  std::free(data_);
}

// Multiply-adds with a memory operand, as the kernels' own loads are.
HM_WIDE std::int32_t Stream::read() const {
  const __m512i one = _mm512_set1_epi16(1);
  __m512i sum[8];
  for (__m512i& s : sum) s = _mm512_setzero_si512();
  for (std::size_t at = 0; at < bytes_ / 4; at += 128)
#pragma GCC unroll 8
    for (std::size_t k = 0; k < 8; ++k)
      sum[k] = _mm512_dpwssd_epi32(sum[k], one, _mm512_load_si512(data_ + at + 16 * k));
  __m512i all = sum[0];
  for (std::size_t k = 1; k < 8; ++k) all = _mm512_add_epi32(all, sum[k]);
  std::int32_t lanes[16];
  _mm512_storeu_si512(lanes, all);
  return lanes[0];
}

// Twelve chains by name: as an array they would lie in memory, and the roof would be the stack's.
HM_WIDE double multiply_add_peak() {
  constexpr int rounds = 20000;
  const __m512i one = _mm512_set1_epi16(1), none = _mm512_setzero_si512();
  __m512i a = none, b = none, c = none, d = none, e = none, f = none;
  __m512i g = none, h = none, i = none, j = none, k = none, l = none;
  for (int r = 0; r < rounds; ++r) {
    a = _mm512_dpwssd_epi32(a, one, one), b = _mm512_dpwssd_epi32(b, one, one);
    c = _mm512_dpwssd_epi32(c, one, one), d = _mm512_dpwssd_epi32(d, one, one);
    e = _mm512_dpwssd_epi32(e, one, one), f = _mm512_dpwssd_epi32(f, one, one);
    g = _mm512_dpwssd_epi32(g, one, one), h = _mm512_dpwssd_epi32(h, one, one);
    i = _mm512_dpwssd_epi32(i, one, one), j = _mm512_dpwssd_epi32(j, one, one);
    k = _mm512_dpwssd_epi32(k, one, one), l = _mm512_dpwssd_epi32(l, one, one);
    __asm__ volatile("" : "+v"(a), "+v"(b), "+v"(c), "+v"(d), "+v"(e), "+v"(f)); // each is done
    __asm__ volatile("" : "+v"(g), "+v"(h), "+v"(i), "+v"(j), "+v"(k), "+v"(l));
  }
  return 32.0 * rounds * 12;
}

} // namespace hopmesh::bench
