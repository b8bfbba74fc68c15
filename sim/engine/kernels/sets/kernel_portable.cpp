// The kernels in plain C++, for every processor; and the meaning of each operation, for readers of the
// others.
#include "sim/engine/kernels/kernel_ahead.h"

namespace hopmesh::engine {
namespace {

struct Portable {
  struct Words {
    std::int32_t at[16];
  };
  struct Longs {
    std::int64_t at[8];
  };
  struct Doubles {
    double at[8];
  };
  using Count = int;
  static constexpr bool few = true; ///< no kernels for what seldom comes here: they take long to compile

  template <typename Op> static Longs each(Op op) {
    Longs r;
    for (int l = 0; l < 8; ++l) r.at[l] = op(l);
    return r;
  }
  template <typename Op> static Words each_word(Op op) {
    Words r;
    for (int l = 0; l < 16; ++l) r.at[l] = op(l);
    return r;
  }
  template <typename Op> static Doubles each_double(Op op) {
    Doubles r;
    for (int l = 0; l < 8; ++l) r.at[l] = op(l);
    return r;
  }

  static Count count(int places) { return places; }
  static Longs all(std::int64_t x) {
    return each([&](int) { return x; });
  }
  static Doubles all_doubles(double x) {
    return each_double([&](int) { return x; });
  }
  static Words no_words() {
    return each_word([](int) { return 0; });
  }
  template <typename Word> static Words load_words(const Word* at) {
    return each_word([&](int l) { return static_cast<std::int32_t>(at[l]); });
  }
  template <typename Word> static void store_words(Word* at, const Words& x) {
    for (int l = 0; l < 16; ++l) at[l] = static_cast<Word>(x.at[l]);
  }
  static Longs load(const std::int64_t* at) {
    return each([&](int l) { return at[l]; });
  }
  static void store(std::int64_t* at, const Longs& x) {
    for (int l = 0; l < 8; ++l) at[l] = x.at[l];
  }
  static Longs load_widened(const std::int32_t* at) {
    return each([&](int l) { return std::int64_t{at[l]}; });
  }
  static Doubles load_doubles(const std::int64_t* at) {
    Doubles r;
    __builtin_memcpy(&r, at, sizeof r);
    return r;
  }

  static Longs add(const Longs& a, const Longs& b) {
    return each([&](int l) { return a.at[l] + b.at[l]; });
  }
  static Longs sub(const Longs& a, const Longs& b) {
    return each([&](int l) { return a.at[l] - b.at[l]; });
  }
  static Longs min(const Longs& a, const Longs& b) {
    return each([&](int l) { return a.at[l] < b.at[l] ? a.at[l] : b.at[l]; });
  }
  static Longs max(const Longs& a, const Longs& b) {
    return each([&](int l) { return a.at[l] > b.at[l] ? a.at[l] : b.at[l]; });
  }
  static Longs absolute(const Longs& a) {
    return each([&](int l) { return a.at[l] < 0 ? -a.at[l] : a.at[l]; });
  }
  static Longs bits_and(const Longs& a, const Longs& b) {
    return each([&](int l) { return a.at[l] & b.at[l]; });
  }
  static Longs signs(const Longs& a) {
    return each([&](int l) { return a.at[l] >> 63; });
  }
  static Longs shift_up(const Longs& a, Count n) {
    return each([&](int l) { return static_cast<std::int64_t>(static_cast<std::uint64_t>(a.at[l]) << n); });
  }
  static Longs shift_down(const Longs& a, Count n) {
    return each([&](int l) { return a.at[l] >> n; });
  }
  static Longs multiply(const Longs& a, const Longs& b) {
    return each([&](int l) { return a.at[l] * b.at[l]; });
  }
  static Longs multiply_low(const Longs& a, const Longs& b) {
    return each([&](int l) {
      return std::int64_t{static_cast<std::int32_t>(a.at[l])} * static_cast<std::int32_t>(b.at[l]);
    });
  }

  static std::int32_t wrapped(std::uint32_t x) { return static_cast<std::int32_t>(x); }
  static Words all_words(std::int64_t x) {
    return each_word([&](int) { return static_cast<std::int32_t>(x); });
  }
  static Words add_words(const Words& a, const Words& b) {
    return each_word([&](int l) {
      return wrapped(static_cast<std::uint32_t>(a.at[l]) + static_cast<std::uint32_t>(b.at[l]));
    });
  }
  static Words sub_words(const Words& a, const Words& b) {
    return each_word([&](int l) {
      return wrapped(static_cast<std::uint32_t>(a.at[l]) - static_cast<std::uint32_t>(b.at[l]));
    });
  }
  static Words min_words(const Words& a, const Words& b) {
    return each_word([&](int l) { return a.at[l] < b.at[l] ? a.at[l] : b.at[l]; });
  }
  static Words max_words(const Words& a, const Words& b) {
    return each_word([&](int l) { return a.at[l] > b.at[l] ? a.at[l] : b.at[l]; });
  }
  static Words words_and(const Words& a, const Words& b) {
    return each_word([&](int l) { return a.at[l] & b.at[l]; });
  }
  static Words word_signs(const Words& a) {
    return each_word([&](int l) { return a.at[l] >> 31; });
  }
  static Words shift_words_down(const Words& a, Count n) {
    return each_word([&](int l) { return a.at[l] >> n; });
  }
  static Words shift_words_up(const Words& a, Count n) {
    return each_word([&](int l) { return wrapped(static_cast<std::uint32_t>(a.at[l]) << n); });
  }
  static Words word_sizes(const Words& a) {
    return each_word([&](int l) {
      const auto x = static_cast<std::uint32_t>(a.at[l]);
      return wrapped(a.at[l] < 0 ? 0u - x : x);
    });
  }
  static Words max_unsigned(const Words& a, const Words& b) {
    return each_word([&](int l) {
      return static_cast<std::uint32_t>(a.at[l]) > static_cast<std::uint32_t>(b.at[l]) ? a.at[l] : b.at[l];
    });
  }

  static Longs low(const Words& a) {
    return each([&](int l) { return std::int64_t{a.at[l]}; });
  }
  static Longs high(const Words& a) {
    return each([&](int l) { return std::int64_t{a.at[8 + l]}; });
  }
  static Words narrow(const Longs& low, const Longs& high) {
    return each_word([&](int l) { return static_cast<std::int32_t>(l < 8 ? low.at[l] : high.at[l - 8]); });
  }

  static Doubles to_doubles(const Longs& a) {
    return each_double([&](int l) { return static_cast<double>(a.at[l]); });
  }
  static Doubles plus(const Doubles& a, const Doubles& b) {
    return each_double([&](int l) { return a.at[l] + b.at[l]; });
  }
  /// x where the mask is -1, zero where it is 0.
  static Doubles where(const Longs& mask, const Doubles& x) {
    return each_double([&](int l) { return mask.at[l] ? x.at[l] : 0.0; });
  }
  static Doubles times(const Doubles& a, const Doubles& b) {
    return each_double([&](int l) { return a.at[l] * b.at[l]; });
  }
  static Doubles low_doubles(const Words& a) {
    return each_double([&](int l) { return static_cast<double>(a.at[l]); });
  }
  static Doubles high_doubles(const Words& a) {
    return each_double([&](int l) { return static_cast<double>(a.at[8 + l]); });
  }
  static Doubles least_of(const Doubles& a, const Doubles& b) {
    return each_double([&](int l) { return a.at[l] < b.at[l] ? a.at[l] : b.at[l]; });
  }
  static Doubles most_of(const Doubles& a, const Doubles& b) {
    return each_double([&](int l) { return a.at[l] > b.at[l] ? a.at[l] : b.at[l]; });
  }
  static Words floor_words(const Doubles& low, const Doubles& high) {
    return narrow(floor_longs(low), floor_longs(high));
  }
  static Longs floor_longs(const Doubles& a) {
    return each([&](int l) {
      const auto whole = static_cast<std::int64_t>(a.at[l]);
      return whole - (static_cast<double>(whole) > a.at[l]);
    });
  }

  static std::int32_t half(std::uint32_t word, int which) {
    return static_cast<std::int16_t>(word >> (16 * which));
  }
  static Words add_products(const Words& sum, const Words& a, const std::uint32_t* b) {
    return each_word([&](int l) {
      const auto word = static_cast<std::uint32_t>(a.at[l]);
      return sum.at[l] + half(word, 0) * half(b[l], 0) + half(word, 1) * half(b[l], 1);
    });
  }
  static Words add_pairs(const Words& sum, const Words& a, const Words& b) {
    return each_word([&](int l) {
      const auto x = static_cast<std::uint32_t>(a.at[l]), y = static_cast<std::uint32_t>(b.at[l]);
      return sum.at[l] + half(x, 0) * half(y, 0) + half(x, 1) * half(y, 1);
    });
  }
  /// sum + sign(s) x.
  static Words add_along(const Words& sum, const Words& x, const Words& s) {
    return each_word([&](int l) { return sum.at[l] + (s.at[l] > 0 ? x.at[l] : s.at[l] < 0 ? -x.at[l] : 0); });
  }
  /// (s b + add) 2^-32, rounded down.
  static Words high_products(const Words& s, const std::int32_t* b, const Longs& add) {
    return each_word([&](int l) {
      return static_cast<std::int32_t>((std::int64_t{s.at[l]} * b[l] + add.at[l / 2]) >> 32);
    });
  }
  static Words add_magnitudes(const Words& sum, const Words& a) {
    return each_word([&](int l) {
      const std::int32_t x = half(static_cast<std::uint32_t>(a.at[l]), 0),
                         y = half(static_cast<std::uint32_t>(a.at[l]), 1);
      return sum.at[l] + (x < 0 ? -x : x) + (y < 0 ? -y : y);
    });
  }
  static Words halves(const Words& low, const Words& high) {
    return each_word([&](int l) {
      return static_cast<std::int32_t>((static_cast<std::uint32_t>(low.at[l]) & 0xFFFFu) |
                                       (static_cast<std::uint32_t>(high.at[l]) & 0xFFFF0000u));
    });
  }
  static Words up_16(const Words& a) {
    return each_word(
        [&](int l) { return static_cast<std::int32_t>(static_cast<std::uint32_t>(a.at[l]) << 16); });
  }
  /// The low half in both.
  static Words twice(const Words& a) { return halves(a, up_16(a)); }

  /// A word that another thread may write at the same time.
  static std::int32_t link(const std::uint32_t* at) {
    return static_cast<std::int32_t>(__atomic_load_n(at, __ATOMIC_RELAXED));
  }
  static Words load_links(const std::uint32_t* at) {
    return each_word([&](int l) { return link(at + l); });
  }
  static void store_links(std::uint32_t* at, const Words& x) {
    for (int l = 0; l < 16; ++l)
      __atomic_store_n(at + l, static_cast<std::uint32_t>(x.at[l]), __ATOMIC_RELAXED);
  }
  static Words pick(const std::uint32_t* from, const std::uint8_t* lane) {
    return each_word([&](int l) { return link(from + lane[l]); });
  }
  static Words gather(const std::uint32_t* plane, const std::uint32_t* slots) {
    return each_word([&](int l) { return link(plane + slots[l]); });
  }
};

} // namespace

const KernelSet portable_kernels = kernels_of<Portable>("portable", nullptr);

} // namespace hopmesh::engine
