// The bit-serial neuron. Every function is one paragraph of docs/hardware/datapath.md.
#include "tests/support/slow_neuron.h"

namespace hopmesh::tests {
namespace {

__int128 wide_with_sign(Wide magnitude, bool negative) {
  return negative ? -static_cast<__int128>(magnitude) : static_cast<__int128>(magnitude);
}

/// Bits up to the highest set one.
int bit_length(Wide x) {
  int n = 0;
  while (x != 0) x >>= 1, ++n;
  return n;
}

Wide row_unit(const spec::Formats& f) {
  return static_cast<Wide>(std::max(f.weight.fraction_bits(), f.bias.fraction_bits()));
}

/// s / N: both brought to the same unit, the quotient to the drive's last place.
std::int64_t divide(const spec::Formats& f, const spec::NumberFormat& accumulator, std::int64_t s, Wide n) {
  const int to_unit = static_cast<int>(row_unit(f)) - accumulator.fraction_bits();
  Wide numerator = magnitude_of(s) << f.drive.fraction_bits(), denominator = n;
  if (to_unit > 0)
    numerator <<= to_unit;
  else
    denominator <<= -to_unit;
  return quantise(cut_quotient(numerator, denominator), s < 0, f.drive);
}

/// s r 2^-(B + M - 2), s in the unit of N; r = floor(2^(B + M - 2) / N).
std::int64_t multiply_by_reciprocal(const spec::ArraySpec& array, const spec::NumberFormat& accumulator,
                                    std::int64_t s, Wide n) {
  const int scale = bit_length(n) + array.reciprocal_bits - 2;
  const __int128 product = multiply(s, reciprocal_of(array, n));
  const int fraction = accumulator.fraction_bits() - static_cast<int>(row_unit(array.formats)) + scale;
  return quantise_code(product, fraction, array.formats.drive);
}

} // namespace

__int128 multiply(std::int64_t a, std::int64_t b) {
  Wide shifted = magnitude_of(a), product = 0;
  for (Wide rest = magnitude_of(b); rest != 0; rest >>= 1, shifted <<= 1)
    if (rest & 1) product += shifted;
  return wide_with_sign(product, (a < 0) != (b < 0));
}

std::int64_t accumulate(const spec::ArraySpec& array, const spec::NumberFormat& format,
                        const std::vector<std::int64_t>& weight, const std::vector<std::int64_t>& link,
                        std::int64_t bias) {
  // Sums are formed in the finer of register and product, then written into the register.
  const int product = array.formats.weight.fraction_bits() + array.formats.link.fraction_bits();
  const int fine = std::max(product, format.fraction_bits());
  std::int64_t s = quantise_code(bias, array.formats.bias.fraction_bits(), format);
  for (std::size_t first = 0; first < weight.size(); first += array.lanes) {
    __int128 sum = wide_with_sign(magnitude_of(s) << (fine - format.fraction_bits()), s < 0);
    for (std::size_t k = first; k < weight.size() && k < first + array.lanes; ++k) {
      const __int128 tap = multiply(weight[k], link[k]);
      sum += wide_with_sign(magnitude_of(tap) << (fine - product), tap < 0);
    }
    s = quantise_code(sum, fine, format);
  }
  return s;
}

Wide row_sum(const spec::ArraySpec& array, const std::vector<std::int64_t>& weight, std::int64_t bias) {
  const int unit = static_cast<int>(row_unit(array.formats));
  Wide n = magnitude_of(bias) << (unit - array.formats.bias.fraction_bits());
  for (std::int64_t w : weight) n += magnitude_of(w) << (unit - array.formats.weight.fraction_bits());
  return n;
}

std::int64_t reciprocal_of(const spec::ArraySpec& array, Wide n) {
  return static_cast<std::int64_t>(
      cut_quotient(Wide{1} << (bit_length(n) + array.reciprocal_bits - 2), n).whole);
}

std::int64_t unlimited_drive(const spec::ArraySpec& array, const spec::NumberFormat& accumulator,
                             std::int64_t s, Wide n) {
  const spec::Formats& f = array.formats;
  const std::int64_t one = std::int64_t{1} << f.drive.fraction_bits();
  if (array.output == spec::Output::binary) return s == 0 ? 0 : s > 0 ? one : -one;
  std::int64_t u = 0;
  if (array.normaliser == spec::Normaliser::prescaled)
    u = quantise_code(s, accumulator.fraction_bits(), f.drive);
  else if (n != 0 && array.normaliser == spec::Normaliser::divider)
    u = divide(f, accumulator, s, n);
  else if (n != 0)
    u = multiply_by_reciprocal(array, accumulator, s, n);
  return u;
}

std::int64_t drive(const spec::ArraySpec& array, const spec::NumberFormat& accumulator, std::int64_t s,
                   Wide n) {
  const std::int64_t one = std::int64_t{1} << array.formats.drive.fraction_bits();
  const std::int64_t u = unlimited_drive(array, accumulator, s, n);
  return u > one ? one : u < -one ? -one : u;
}

std::int64_t change(const spec::Formats& f, std::int64_t v, std::int64_t u) {
  const std::int64_t one = std::int64_t{1} << f.state.fraction_bits();
  const std::int64_t r = u >= 0 ? one - v : one + v;
  const __int128 product = multiply(r, u); // in units of 2^-(F_state + F_drive)
  const Cut cut = cut_bits(magnitude_of(product), f.drive.fraction_bits(), 0);
  return static_cast<std::int64_t>(
      wide_with_sign(round_cut(cut, product < 0, f.state.rounding), product < 0));
}

std::int64_t link_code(const spec::Formats& f, std::int64_t v) {
  return quantise_code(v, f.state.fraction_bits(), f.link);
}

} // namespace hopmesh::tests
