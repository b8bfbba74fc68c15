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

HM_WIDE double multiply_add_peak() {
  constexpr int rounds = 20000, chains = 12;
  __m512i sum[chains], one = _mm512_set1_epi16(1);
  for (__m512i& s : sum) s = _mm512_setzero_si512();
  for (int r = 0; r < rounds; ++r) {
#pragma GCC unroll 12
    for (int k = 0; k < chains; ++k) {
      sum[k] = _mm512_dpwssd_epi32(sum[k], one, one);
      __asm__ volatile("" : "+v"(sum[k])); // each is done
    }
  }
  return 32.0 * rounds * chains;
}

} // namespace hopmesh::bench
