// Rounding and overflow decided bit by bit, with the rules of SystemC's fixed-point types written as a table.
#include "tests/support/slow_fixed.h"

#include <cstring>

namespace hopmesh::tests {
namespace {

constexpr int room = 126; // bits of `whole`; one is left for the carry of rounding

bool bit(Wide x, int k) {
  return k >= 0 && k < 128 && ((x >> k) & 1) != 0;
}

/// Does the magnitude grow by one last place? `odd`: its last kept bit is set.
bool rounds_away(bool half, bool rest, bool odd, bool negative, spec::Rounding mode) {
  const bool above_tie = half && rest;
  switch (mode) {
  case spec::Rounding::rnd:
    return negative ? above_tie : half; // nearest, ties to +infinity
  case spec::Rounding::rnd_zero:
    return above_tie; // nearest, ties to zero
  case spec::Rounding::rnd_min_inf:
    return negative ? half : above_tie; // nearest, ties to -infinity
  case spec::Rounding::rnd_inf:
    return half; // nearest, ties away from zero
  case spec::Rounding::rnd_conv:
    return above_tie || (half && odd); // nearest, ties to even
  case spec::Rounding::trn:
    return negative && (half || rest); // to -infinity
  case spec::Rounding::trn_zero:
    return false; // to zero
  }
  return false;
}

std::int64_t with_sign(Wide magnitude, bool negative) {
  const auto code = static_cast<std::int64_t>(magnitude);
  return negative ? -code : code;
}

/// The low bits of the two's complement of the number, read as a number of that many bits.
std::int64_t low_bits(Wide magnitude, bool negative, int width) {
  const Wide modulus = Wide{1} << width;
  Wide low = magnitude % modulus;
  if (negative && low != 0) low = modulus - low;
  return low < modulus / 2 ? with_sign(low, false) : with_sign(modulus - low, true);
}

} // namespace

Cut cut_bits(Wide magnitude, int fraction, int kept_fraction) {
  const int cut = fraction - kept_fraction; // this bit of the magnitude lands on the last place
  Cut c;
  int place = -cut;
  for (Wide above = magnitude; above != 0; above >>= 1, ++place) {
    if ((above & 1) == 0) continue;
    if (place >= room)
      c.beyond = true;
    else if (place >= 0)
      c.whole |= Wide{1} << place;
    else if (place == -1)
      c.half = true;
    else
      c.rest = true;
  }
  return c;
}

Cut cut_quotient(Wide numerator, Wide denominator) {
  Cut c;
  Wide remainder = 0;
  int top = 127;
  while (top >= 0 && !bit(numerator, top)) --top;
  for (int k = top; k >= -1; --k) {
    remainder = 2 * remainder + bit(numerator, k);
    const bool fits = remainder >= denominator;
    if (fits) remainder -= denominator;
    if (k < 0)
      c.half = fits;
    else if (fits && k >= room)
      c.beyond = true;
    else if (fits)
      c.whole |= Wide{1} << k;
  }
  c.rest = remainder != 0;
  return c;
}

Wide round_cut(const Cut& cut, bool negative, spec::Rounding mode) {
  return cut.whole + rounds_away(cut.half, cut.rest, bit(cut.whole, 0), negative, mode);
}

std::int64_t bring_into_range(Wide magnitude, bool beyond, bool negative, const spec::NumberFormat& format) {
  const Wide largest = (Wide{1} << (format.width - 1)) - 1;
  const Wide lowest =
      largest + (format.overflow == spec::Overflow::sat_sym ? 0 : 1); // magnitude of the minimum
  const Wide limit = negative ? lowest : largest;
  if (!beyond && magnitude <= limit) return with_sign(magnitude, negative);
  if (format.overflow == spec::Overflow::sat_zero) return 0;
  if (format.overflow == spec::Overflow::wrap) return low_bits(magnitude, negative, format.width);
  return with_sign(limit, negative);
}

std::int64_t quantise(const Cut& cut, bool negative, const spec::NumberFormat& format) {
  return bring_into_range(round_cut(cut, negative, format.rounding), cut.beyond, negative, format);
}

std::int64_t quantise_code(__int128 code, int fraction, const spec::NumberFormat& format) {
  return quantise(cut_bits(magnitude_of(code), fraction, format.fraction_bits()), code < 0, format);
}

std::int64_t quantise_double(double value, int shift, const spec::NumberFormat& format) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  const int exponent = static_cast<int>(bits >> 52 & 0x7FF);
  std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52) - 1);
  if (exponent != 0) mantissa |= std::uint64_t{1} << 52;
  const int fraction =
      1075 - (exponent == 0 ? 1 : exponent) - shift; // value = mantissa * 2^-(1075 - exponent)
  return quantise(cut_bits(mantissa, fraction, format.fraction_bits()), (bits >> 63) != 0, format);
}

} // namespace hopmesh::tests
