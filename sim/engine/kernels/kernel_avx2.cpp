// Kernels for processors with AVX2. What 64-bit lanes lack there is built from what they have.
#include "sim/engine/kernels/kernel_ahead.h"

#include <immintrin.h>

namespace hopmesh::engine {
namespace {

struct Avx2 {
  struct Words {
    __m256i half[2];
  };
  struct Longs {
    __m256i half[2];
  };
  struct Doubles {
    __m256d half[2];
  };
  using Count = __m128i;
  static constexpr bool few = false;

  template <typename Op> static Longs both(Op op) { return {{op(0), op(1)}}; }
  template <typename Op> static Words both_words(Op op) { return {{op(0), op(1)}}; }
  template <typename Op> static Doubles both_doubles(Op op) { return {{op(0), op(1)}}; }

  static Count count(int places) { return _mm_cvtsi32_si128(places); }
  static Longs all(std::int64_t x) { return {{_mm256_set1_epi64x(x), _mm256_set1_epi64x(x)}}; }
  static Doubles all_doubles(double x) { return {{_mm256_set1_pd(x), _mm256_set1_pd(x)}}; }
  static Words no_words() { return {{_mm256_setzero_si256(), _mm256_setzero_si256()}}; }
  static __m256i load_half(const void* at) { return _mm256_loadu_si256(static_cast<const __m256i*>(at)); }
  template <typename Word> static Words load_words(const Word* at) {
    return {{load_half(at), load_half(at + 8)}};
  }
  template <typename Word> static void store_words(Word* at, const Words& x) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at), x.half[0]);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(at + 8), x.half[1]);
  }
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

  static Words add_products(const Words& sum, const Words& a, const std::uint32_t* b) {
    return both_words([&](int h) {
      return _mm256_add_epi32(sum.half[h], _mm256_madd_epi16(load_half(b + 8 * h), a.half[h]));
    });
  }
  static Words add_pairs(const Words& sum, const Words& a, const Words& b) {
    return both_words(
        [&](int h) { return _mm256_add_epi32(sum.half[h], _mm256_madd_epi16(a.half[h], b.half[h])); });
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

const KernelSet avx2_kernels = kernels_of<Avx2>("avx2");

} // namespace hopmesh::engine
