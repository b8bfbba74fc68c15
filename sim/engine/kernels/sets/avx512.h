// What kernels do with the registers of processors with AVX-512 (F, BW, VL, DQ, VNNI).
#pragma once

#include "sim/engine/kernels/kernel.h"

#include <immintrin.h>

namespace hopmesh::engine {
namespace {

struct Avx512 {
  using Words = __m512i;
  using Longs = __m512i;
  using Doubles = __m512d;
  using Count = __m128i;
  static constexpr bool few = false;

  static Count count(int places) { return _mm_cvtsi32_si128(places); }
  static Longs all(std::int64_t x) { return _mm512_set1_epi64(x); }
  static Doubles all_doubles(double x) { return _mm512_set1_pd(x); }
  static Words no_words() { return _mm512_setzero_si512(); }
  static Words load_words(const void* at) { return _mm512_loadu_si512(at); }
  static void store_words(void* at, Words x) { _mm512_storeu_si512(at, x); }
  static Longs load(const std::int64_t* at) { return _mm512_loadu_si512(at); }
  static void store(std::int64_t* at, Longs x) { _mm512_storeu_si512(at, x); }
  static Longs load_widened(const std::int32_t* at) {
    return _mm512_cvtepi32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)));
  }
  static Doubles load_doubles(const std::int64_t* at) { return _mm512_castsi512_pd(load(at)); }

  static Longs add(Longs a, Longs b) { return _mm512_add_epi64(a, b); }
  static Longs sub(Longs a, Longs b) { return _mm512_sub_epi64(a, b); }
  static Longs min(Longs a, Longs b) { return _mm512_min_epi64(a, b); }
  static Longs max(Longs a, Longs b) { return _mm512_max_epi64(a, b); }
  static Longs absolute(Longs a) { return _mm512_abs_epi64(a); }
  static Longs bits_and(Longs a, Longs b) { return _mm512_and_si512(a, b); }
  static Longs signs(Longs a) { return _mm512_srai_epi64(a, 63); }
  static Longs shift_up(Longs a, Count n) { return _mm512_sll_epi64(a, n); }
  static Longs shift_down(Longs a, Count n) { return _mm512_sra_epi64(a, n); }
  static Longs multiply(Longs a, Longs b) { return _mm512_mullo_epi64(a, b); }
  static Longs multiply_low(Longs a, Longs b) { return _mm512_mul_epi32(a, b); }

  static Words all_words(std::int64_t x) { return _mm512_set1_epi32(static_cast<int>(x)); }
  static Words add_words(Words a, Words b) { return _mm512_add_epi32(a, b); }
  static Words sub_words(Words a, Words b) { return _mm512_sub_epi32(a, b); }
  static Words min_words(Words a, Words b) { return _mm512_min_epi32(a, b); }
  static Words max_words(Words a, Words b) { return _mm512_max_epi32(a, b); }
  static Words words_and(Words a, Words b) { return _mm512_and_si512(a, b); }
  static Words word_signs(Words a) { return _mm512_srai_epi32(a, 31); }
  static Words shift_words_down(Words a, Count n) { return _mm512_sra_epi32(a, n); }
  static Words shift_words_up(Words a, Count n) { return _mm512_sll_epi32(a, n); }
  static Words word_sizes(Words a) { return _mm512_abs_epi32(a); }
  static Words max_unsigned(Words a, Words b) { return _mm512_max_epu32(a, b); }

  static Longs low(Words a) { return _mm512_cvtepi32_epi64(_mm512_castsi512_si256(a)); }
  static Longs high(Words a) { return _mm512_cvtepi32_epi64(_mm512_extracti64x4_epi64(a, 1)); }
  static Words narrow(Longs low, Longs high) {
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    return _mm512_permutex2var_epi32(low, even, high);
  }

  static Doubles to_doubles(Longs a) { return _mm512_cvtepi64_pd(a); }
  static Doubles low_doubles(Words a) { return _mm512_cvtepi32_pd(_mm512_castsi512_si256(a)); }
  static Doubles high_doubles(Words a) { return _mm512_cvtepi32_pd(_mm512_extracti64x4_epi64(a, 1)); }
  static Doubles least_of(Doubles a, Doubles b) { return _mm512_min_pd(a, b); }
  static Doubles most_of(Doubles a, Doubles b) { return _mm512_max_pd(a, b); }
  static Words floor_words(Doubles low, Doubles high) {
    const auto floor = [](Doubles a) {
      return _mm512_cvt_roundpd_epi32(a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
    };
    return _mm512_inserti64x4(_mm512_castsi256_si512(floor(low)), floor(high), 1);
  }
  static Doubles plus(Doubles a, Doubles b) { return _mm512_add_pd(a, b); }
  static Doubles where(Longs mask, Doubles x) { return _mm512_and_pd(_mm512_castsi512_pd(mask), x); }
  static Doubles times(Doubles a, Doubles b) { return _mm512_mul_pd(a, b); }
  static Longs floor_longs(Doubles a) {
    return _mm512_cvt_roundpd_epi64(a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC);
  }

  static Words add_products(Words sum, Words a, const std::uint32_t* b) {
    return _mm512_dpwssd_epi32(sum, load_words(b), a);
  }
  static Words add_pairs(Words sum, Words a, Words b) { return _mm512_dpwssd_epi32(sum, a, b); }
  static Words add_along(Words sum, Words x, Words s) {
    sum = _mm512_mask_add_epi32(sum, _mm512_cmpgt_epi32_mask(s, no_words()), sum, x);
    return _mm512_mask_sub_epi32(sum, _mm512_movepi32_mask(s), sum, x);
  }
  static Words high_products(Words s, const std::int32_t* b, Longs add) {
    // An upper half comes down by a shuffle, since shifts have one port only.
    const Longs even = _mm512_mul_epi32(s, load_words(b));
    const Longs odd = _mm512_mul_epi32(_mm512_shuffle_epi32(s, _MM_PERM_DDBB), load_words(b + 1));
    return _mm512_mask_shuffle_epi32(_mm512_add_epi64(odd, add), 0x5555, _mm512_add_epi64(even, add),
                                     _MM_PERM_DDBB);
  }
  static Words add_magnitudes(Words sum, Words a) {
    const Words ones = _mm512_set1_epi16(1), signs = _mm512_srai_epi16(a, 15);
    return _mm512_sub_epi32(_mm512_dpwssd_epi32(sum, _mm512_xor_si512(a, signs), ones),
                            _mm512_madd_epi16(signs, ones));
  }
  /// Low halves of `low`, high halves of `high`.
  static Words halves(Words low, Words high) { return _mm512_mask_blend_epi16(0xAAAAAAAAu, low, high); }
  static Words up_16(Words a) { return _mm512_slli_epi32(a, 16); }
  static Words twice(Words a) {
    return _mm512_shuffle_epi8(a, _mm512_set4_epi32(0x0D0C0D0C, 0x09080908, 0x05040504, 0x01000100));
  }

  // A vector of words is read and written word by word as far as other threads can see. The language has no
  // name for that, so the thread sanitizer is told not to look.
  __attribute__((no_sanitize("thread"))) static Words load_links(const std::uint32_t* at) {
    return _mm512_loadu_si512(at);
  }
  static void store_links(std::uint32_t* at, Words x) { store_words(at, x); }
  static Words pick(const std::uint32_t* from, const std::uint8_t* lane) {
    const Words index = _mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(lane)));
    return _mm512_permutex2var_epi32(load_links(from), index, load_links(from + 16));
  }
  static Words gather(const std::uint32_t* plane, const std::uint32_t* slots) {
    return _mm512_i32gather_epi32(load_words(slots), plane, 4);
  }
};

} // namespace
} // namespace hopmesh::engine
