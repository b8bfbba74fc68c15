// What kernels do with the registers of processors with AVX2. What 64-bit lanes lack there is built from what
// they have.
#pragma once

#include "sim/engine/kernels/sets/avx2_words.h"

namespace hopmesh::engine {
namespace {

struct Avx2 : Avx2Words {
  struct Longs {
    __m256i half[2];
  };
  struct Doubles {
    __m256d half[2];
  };
  static constexpr bool few = false;

  template <typename Op> static Longs both(Op op) { return {{op(0), op(1)}}; }
  template <typename Op> static Doubles both_doubles(Op op) { return {{op(0), op(1)}}; }

  static Longs all(std::int64_t x) { return {{_mm256_set1_epi64x(x), _mm256_set1_epi64x(x)}}; }
  static Doubles all_doubles(double x) { return {{_mm256_set1_pd(x), _mm256_set1_pd(x)}}; }
  static Longs load(const std::int64_t* at) { return {{load_half(at), load_half(at + 4)}}; }
  static void store(std::int64_t* at, const Longs& x) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at), x.half[0]);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at + 4), x.half[1]);
  }
  static Longs load_widened(const std::int32_t* at) {
    return {{widen(load_half(at), 0), widen(load_half(at), 1)}};
  }
  static Doubles load_doubles(const std::int64_t* at) {
    return {{_mm256_castsi256_pd(load_half(at)), _mm256_castsi256_pd(load_half(at + 4))}};
  }

  static Longs add(const Longs& a, const Longs& b) {
    return both([&](int h) { return _mm256_add_epi64(a.half[h], b.half[h]); });
  }
  static Longs sub(const Longs& a, const Longs& b) {
    return both([&](int h) { return _mm256_sub_epi64(a.half[h], b.half[h]); });
  }
  static Longs min(const Longs& a, const Longs& b) {
    return both([&](int h) {
      return _mm256_blendv_epi8(a.half[h], b.half[h], _mm256_cmpgt_epi64(a.half[h], b.half[h]));
    });
  }
  static Longs max(const Longs& a, const Longs& b) {
    return both([&](int h) {
      return _mm256_blendv_epi8(b.half[h], a.half[h], _mm256_cmpgt_epi64(a.half[h], b.half[h]));
    });
  }
  static Longs absolute(const Longs& a) {
    const Longs sign = signs(a);
    return sub(bits_xor(a, sign), sign);
  }
  static Longs bits_and(const Longs& a, const Longs& b) {
    return both([&](int h) { return _mm256_and_si256(a.half[h], b.half[h]); });
  }
  static Longs bits_xor(const Longs& a, const Longs& b) {
    return both([&](int h) { return _mm256_xor_si256(a.half[h], b.half[h]); });
  }
  static Longs signs(const Longs& a) {
    return both([&](int h) { return _mm256_cmpgt_epi64(_mm256_setzero_si256(), a.half[h]); });
  }
  static Longs shift_up(const Longs& a, Count n) {
    return both([&](int h) { return _mm256_sll_epi64(a.half[h], n); });
  }
  static Longs shift_down(const Longs& a, Count n) {
    const Longs sign = signs(a), size = bits_xor(a, sign);
    return bits_xor(both([&](int h) { return _mm256_srl_epi64(size.half[h], n); }), sign);
  }
  static Longs multiply(const Longs& a, const Longs& b) {
    return both([&](int h) {
      const __m256i x = a.half[h], y = b.half[h], low = _mm256_mul_epu32(x, y);
      const __m256i cross = _mm256_add_epi64(_mm256_mul_epu32(_mm256_srli_epi64(x, 32), y),
                                             _mm256_mul_epu32(x, _mm256_srli_epi64(y, 32)));
      return _mm256_add_epi64(low, _mm256_slli_epi64(cross, 32));
    });
  }
  static Longs multiply_low(const Longs& a, const Longs& b) {
    return both([&](int h) { return _mm256_mul_epi32(a.half[h], b.half[h]); });
  }

  static __m256i widen(__m256i words, int which) {
    return _mm256_cvtepi32_epi64(which ? _mm256_extracti128_si256(words, 1) : _mm256_castsi256_si128(words));
  }
  static Longs low(const Words& a) { return {{widen(a.half[0], 0), widen(a.half[0], 1)}}; }
  static Longs high(const Words& a) { return {{widen(a.half[1], 0), widen(a.half[1], 1)}}; }
  static __m256i narrow_half(const Longs& a) {
    const __m256i pairs = _mm256_castps_si256(
        _mm256_shuffle_ps(_mm256_castsi256_ps(a.half[0]), _mm256_castsi256_ps(a.half[1]), 0x88));
    return _mm256_permute4x64_epi64(pairs, 0xD8);
  }
  static Words narrow(const Longs& low, const Longs& high) { return {{narrow_half(low), narrow_half(high)}}; }

  // Added to 1.5 * 2^52, a number below 2^51 stands in the low bits of the mantissa.
  static constexpr double magic = 6755399441055744.0;
  static __m256i magic_bits() { return _mm256_castpd_si256(_mm256_set1_pd(magic)); }
  static Doubles to_doubles(const Longs& a) {
    return both_doubles([&](int h) {
      return _mm256_sub_pd(_mm256_castsi256_pd(_mm256_add_epi64(a.half[h], magic_bits())),
                           _mm256_set1_pd(magic));
    });
  }
  static Longs floor_longs(const Doubles& a) {
    return both([&](int h) {
      const __m256d whole = _mm256_add_pd(_mm256_floor_pd(a.half[h]), _mm256_set1_pd(magic));
      return _mm256_sub_epi64(_mm256_castpd_si256(whole), magic_bits());
    });
  }
  static __m256d doubles_of(__m256i words, int which) {
    return _mm256_cvtepi32_pd(which ? _mm256_extracti128_si256(words, 1) : _mm256_castsi256_si128(words));
  }
  static Doubles low_doubles(const Words& a) {
    return {{doubles_of(a.half[0], 0), doubles_of(a.half[0], 1)}};
  }
  static Doubles high_doubles(const Words& a) {
    return {{doubles_of(a.half[1], 0), doubles_of(a.half[1], 1)}};
  }
  static Doubles least_of(const Doubles& a, const Doubles& b) {
    return both_doubles([&](int h) { return _mm256_min_pd(a.half[h], b.half[h]); });
  }
  static Doubles most_of(const Doubles& a, const Doubles& b) {
    return both_doubles([&](int h) { return _mm256_max_pd(a.half[h], b.half[h]); });
  }
  static __m256i floor_half(const Doubles& a) {
    return _mm256_set_m128i(_mm256_cvttpd_epi32(_mm256_floor_pd(a.half[1])),
                            _mm256_cvttpd_epi32(_mm256_floor_pd(a.half[0])));
  }
  static Words floor_words(const Doubles& low, const Doubles& high) {
    return {{floor_half(low), floor_half(high)}};
  }
  static Doubles plus(const Doubles& a, const Doubles& b) {
    return both_doubles([&](int h) { return _mm256_add_pd(a.half[h], b.half[h]); });
  }
  static Doubles where(const Longs& mask, const Doubles& x) {
    return both_doubles([&](int h) { return _mm256_and_pd(_mm256_castsi256_pd(mask.half[h]), x.half[h]); });
  }
  static Doubles times(const Doubles& a, const Doubles& b) {
    return both_doubles([&](int h) { return _mm256_mul_pd(a.half[h], b.half[h]); });
  }
};

} // namespace
} // namespace hopmesh::engine
