// A fixed-point number format as a value: fixed<W,I,Q,O> with SystemC's meaning and names.
// Facts only: ranges and names. Nobody's rounding lives here; every model rounds by itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <regex>
#include <string>
#include <string_view>

namespace hopmesh::spec {

/// What becomes of a value between two codes, in SystemC's order (sc_q_mode, IEEE 1666 7.10.9.1).
/// docs/hardware/number-formats.md draws each mode as a staircase.
enum class Rounding : std::uint8_t {
  rnd,         ///< to the nearest code; a tie goes up
  rnd_zero,    ///< to the nearest code; a tie goes toward zero
  rnd_min_inf, ///< to the nearest code; a tie goes down
  rnd_inf,     ///< to the nearest code; a tie goes away from zero
  rnd_conv,    ///< to the nearest code; a tie goes to the even code
  trn,         ///< down: the bits behind the last place are cut off
  trn_zero     ///< toward zero: the magnitude is cut off
};
inline constexpr std::array<std::string_view, 7> rounding_names{
    "SC_RND", "SC_RND_ZERO", "SC_RND_MIN_INF", "SC_RND_INF", "SC_RND_CONV", "SC_TRN", "SC_TRN_ZERO"};

/// What becomes of a code beyond the format's range, in SystemC's order (sc_o_mode).
enum class Overflow : std::uint8_t {
  sat,      ///< the nearest end of the range
  sat_zero, ///< zero
  sat_sym, ///< the nearest end of a range without its least code, so that both ends are equally far from zero
  wrap     ///< the low bits, sign extended: SystemC's SC_WRAP with zero saturated bits
};
inline constexpr std::array<std::string_view, 4> overflow_names{"SC_SAT", "SC_SAT_ZERO", "SC_SAT_SYM",
                                                                "SC_WRAP"};

inline std::string_view name_of(Rounding q) {
  return rounding_names[static_cast<std::size_t>(q)];
}
inline std::string_view name_of(Overflow o) {
  return overflow_names[static_cast<std::size_t>(o)];
}

/// fixed<W,I,Q,O>: `width` bits in two's complement, `integer_bits` of them before the point, sign included.
/// A raw code c stands for the value c * 2^-fraction_bits().
struct NumberFormat {
  int width = 16;
  int integer_bits = 2;
  Rounding rounding = Rounding::trn_zero;
  Overflow overflow = Overflow::sat;

  constexpr int fraction_bits() const { return width - integer_bits; }
  std::int64_t max_raw() const { return (std::int64_t{1} << (width - 1)) - 1; }
  std::int64_t min_raw() const { return -max_raw() - (overflow == Overflow::sat_sym ? 0 : 1); }
  /// Raw code of the value 1.0; needs fraction_bits() >= 0, and integer_bits >= 2 to be representable.
  std::int64_t one_raw() const { return std::int64_t{1} << fraction_bits(); }
  std::string text() const {
    return "fixed<" + std::to_string(width) + "," + std::to_string(integer_bits) + "," +
           std::string(name_of(rounding)) + "," + std::string(name_of(overflow)) + ">";
  }
  bool operator==(const NumberFormat& other) const {
    return width == other.width && integer_bits == other.integer_bits && rounding == other.rounding &&
           overflow == other.overflow;
  }
};

/// Codes of the table of m, whatever the other formats: values in [-1, 1).
inline constexpr NumberFormat momentum_format{16, 1, Rounding::rnd, Overflow::sat};

template <typename Mode, std::size_t n>
std::optional<Mode> mode_named(std::string_view name, const std::array<std::string_view, n>& names) {
  for (std::size_t k = 0; k < n; ++k)
    if (names[k] == name) return static_cast<Mode>(k);
  return std::nullopt;
}

/// Reads "fixed<W,I>", "fixed<W,I,Q>" or "fixed<W,I,Q,O>"; SystemC's defaults (SC_TRN, SC_WRAP) where left
/// out. Nothing when the text is no format. Widths are judged by validate() of array_spec.h.
inline std::optional<NumberFormat> parse_format(const std::string& text) {
  constexpr std::size_t longest = 80; // std::regex recurses over its text
  if (text.size() > longest) return std::nullopt;
  static const std::regex shape(
      R"(\s*fixed\s*<\s*(\d{1,3})\s*,\s*(-?\d{1,3})\s*(?:,\s*(\w+)\s*)?(?:,\s*(\w+)\s*)?>\s*)");
  std::smatch part;
  if (!std::regex_match(text, part, shape)) return std::nullopt;
  const auto rounding = mode_named<Rounding>(part[3].matched ? part[3].str() : "SC_TRN", rounding_names);
  const auto overflow = mode_named<Overflow>(part[4].matched ? part[4].str() : "SC_WRAP", overflow_names);
  if (!rounding || !overflow) return std::nullopt;
  return NumberFormat{std::stoi(part[1]), std::stoi(part[2]), *rounding, *overflow};
}

} // namespace hopmesh::spec
