// What kernels do with sixteen words in registers of processors with AVX2: the first part of avx2.h.
#pragma once

#include "sim/engine/kernels/kernel.h"

#include <immintrin.h>

namespace hopmesh::engine {
namespace {

struct Avx2Words {
  struct Words {
    __m256i half[2];
  };
  using Count = __m128i;

  template <typename Op> static Words both_words(Op op) { return {{op(0), op(1)}}; }
  static Count count(int places) { return _mm_cvtsi32_si128(places); }
  static Words no_words() { return {{_mm256_setzero_si256(), _mm256_setzero_si256()}}; }
  static __m256i load_half(const void* at) { return _mm256_loadu_si256(static_cast<const __m256i*>(at)); }
  template <typename Word> static Words load_words(const Word* at) {
    return {{load_half(at), load_half(at + 8)}};
  }
  template <typename Word> static void store_words(Word* at, const Words& x) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at), x.half[0]);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at + 8), x.half[1]);
  }

  static Words all_words(std::int64_t x) {
    const __m256i all = _mm256_set1_epi32(static_cast<int>(x));
    return {{all, all}};
  }
  static Words add_words(const Words& a, const Words& b) {
    return both_words([&](int h) { return _mm256_add_epi32(a.half[h], b.half[h]); });
  }
  static Words sub_words(const Words& a, const Words& b) {
    return both_words([&](int h) { return _mm256_sub_epi32(a.half[h], b.half[h]); });
  }
  static Words min_words(const Words& a, const Words& b) {
    return both_words([&](int h) { return _mm256_min_epi32(a.half[h], b.half[h]); });
  }
  static Words max_words(const Words& a, const Words& b) {
    return both_words([&](int h) { return _mm256_max_epi32(a.half[h], b.half[h]); });
  }
  static Words words_and(const Words& a, const Words& b) {
    return both_words([&](int h) { return _mm256_and_si256(a.half[h], b.half[h]); });
  }
  static Words word_signs(const Words& a) {
    return both_words([&](int h) { return _mm256_srai_epi32(a.half[h], 31); });
  }
  static Words shift_words_down(const Words& a, Count n) {
    return both_words([&](int h) { return _mm256_sra_epi32(a.half[h], n); });
  }
  static Words shift_words_up(const Words& a, Count n) {
    return both_words([&](int h) { return _mm256_sll_epi32(a.half[h], n); });
  }
  static Words word_sizes(const Words& a) {
    return both_words([&](int h) { return _mm256_abs_epi32(a.half[h]); });
  }
  static Words max_unsigned(const Words& a, const Words& b) {
    return both_words([&](int h) { return _mm256_max_epu32(a.half[h], b.half[h]); });
  }

  static Words add_products(const Words& sum, const Words& a, const std::uint32_t* b) {
    return both_words([&](int h) {
      return _mm256_add_epi32(sum.half[h], _mm256_madd_epi16(load_half(b + 8 * h), a.half[h]));
    });
  }
  static Words add_pairs(const Words& sum, const Words& a, const Words& b) {
    return both_words(
        [&](int h) { return _mm256_add_epi32(sum.half[h], _mm256_madd_epi16(a.half[h], b.half[h])); });
  }
  static Words add_along(const Words& sum, const Words& x, const Words& s) {
    return both_words(
        [&](int h) { return _mm256_add_epi32(sum.half[h], _mm256_sign_epi32(x.half[h], s.half[h])); });
  }
  template <typename Longs>
  static Words high_products(const Words& s, const std::int32_t* b, const Longs& add) {
    return both_words([&](int h) {
      const __m256i even = _mm256_mul_epi32(s.half[h], load_half(b + 8 * h));
      const __m256i odd = _mm256_mul_epi32(_mm256_srli_epi64(s.half[h], 32), load_half(b + 8 * h + 1));
      return _mm256_blend_epi32(_mm256_srli_epi64(_mm256_add_epi64(even, add.half[h]), 32),
                                _mm256_add_epi64(odd, add.half[h]), 0xAA);
    });
  }
  static Words add_magnitudes(const Words& sum, const Words& a) {
    const __m256i ones = _mm256_set1_epi16(1);
    return both_words([&](int h) {
      const __m256i sign = _mm256_srai_epi16(a.half[h], 15), size = _mm256_xor_si256(a.half[h], sign);
      return _mm256_add_epi32(sum.half[h],
                              _mm256_sub_epi32(_mm256_madd_epi16(size, ones), _mm256_madd_epi16(sign, ones)));
    });
  }
  static Words halves(const Words& low, const Words& high) {
    return both_words([&](int h) { return _mm256_blend_epi16(low.half[h], high.half[h], 0xAA); });
  }
  static Words up_16(const Words& a) {
    return both_words([&](int h) { return _mm256_slli_epi32(a.half[h], 16); });
  }

  static Words twice(const Words& a) {
    const __m256i both = _mm256_set_epi32(0x0D0C0D0C, 0x09080908, 0x05040504, 0x01000100, 0x0D0C0D0C,
                                          0x09080908, 0x05040504, 0x01000100);
    return both_words([&](int h) { return _mm256_shuffle_epi8(a.half[h], both); });
  }

  static __m256i gathered(const std::uint32_t* from, __m256i index) {
    return _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), index, 4);
  }
  // A vector of words is read and written word by word as far as other threads can see. The language has no
  // name for that, so the thread sanitizer is told not to look.
  __attribute__((no_sanitize("thread"))) static Words load_links(const std::uint32_t* at) {
    const auto* half = reinterpret_cast<const __m256i*>(at);
    return {{_mm256_loadu_si256(half), _mm256_loadu_si256(half + 1)}};
  }
  static void store_links(std::uint32_t* at, const Words& x) { store_words(at, x); }
  static Words pick(const std::uint32_t* from, const std::uint8_t* lane) {
    return both_words([&](int h) {
      const auto* eight = reinterpret_cast<const __m128i*>(lane + 8 * h);
      return gathered(from, _mm256_cvtepu8_epi32(_mm_loadl_epi64(eight)));
    });
  }
  static Words gather(const std::uint32_t* plane, const std::uint32_t* slots) {
    return both_words([&](int h) { return gathered(plane, load_half(slots + 8 * h)); });
  }
};

} // namespace
} // namespace hopmesh::engine
