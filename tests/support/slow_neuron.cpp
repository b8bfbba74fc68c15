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

/// omega of `projected`, as a factor and the places that the sum moves down by then; 1 elsewhere.
struct Factor {
  Wide times = 1;
  int places = 0;
};

Factor factor_of(const spec::ArraySpec& array) {
  if (array.output != spec::Output::projected) return {};
  return {static_cast<Wide>(array.relaxation), 4};
}

/// s / N: both brought to the same unit, the quotient to the drive's last place.
Cut divided(const spec::ArraySpec& array, const spec::NumberFormat& accumulator, std::int64_t s, Wide n) {
  const spec::Formats& f = array.formats;
  const Factor factor = factor_of(array);
  const int to_unit = static_cast<int>(row_unit(f)) - accumulator.fraction_bits();
  Wide numerator = magnitude_of(s) * factor.times << f.drive.fraction_bits();
  Wide denominator = n << factor.places;
  if (to_unit > 0)
    numerator <<= to_unit;
  else
    denominator <<= -to_unit;
  return cut_quotient(numerator, denominator);
}

/// s r 2^-(B + M - 2), s in the unit of N; r = floor(2^(B + M - 2) / N).
Cut multiplied(const spec::ArraySpec& array, const spec::NumberFormat& accumulator, std::int64_t s, Wide n) {
  const Factor factor = factor_of(array);
  const int scale = bit_length(n) + array.reciprocal_bits - 2;
  const Wide product = magnitude_of(multiply(s, reciprocal_of(array, n))) * factor.times;
  const int fraction =
      accumulator.fraction_bits() - static_cast<int>(row_unit(array.formats)) + scale + factor.places;
  return cut_bits(product, fraction, array.formats.drive.fraction_bits());
}

std::int64_t held(std::int64_t x, std::int64_t most) {
  return x > most ? most : x < -most ? -most : x;
}

/// Rounded, then held within `most` last places: no overflow mode has a say.
std::int64_t round_and_hold(const Cut& cut, bool negative, spec::Rounding mode, std::int64_t most) {
  const Wide size = round_cut(cut, negative, mode);
  const bool over = cut.beyond || size > static_cast<Wide>(most);
  return static_cast<std::int64_t>(wide_with_sign(over ? static_cast<Wide>(most) : size, negative));
}

/// code * 2^-fraction in last places of the state, by its rounding mode.
std::int64_t in_state_places(const spec::Formats& f, std::int64_t code, int fraction) {
  const Cut cut = cut_bits(magnitude_of(code), fraction, f.state.fraction_bits());
  return static_cast<std::int64_t>(wide_with_sign(round_cut(cut, code < 0, f.state.rounding), code < 0));
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

Wide divisor(const spec::ArraySpec& array, const std::vector<std::int64_t>& weight, std::size_t own,
             std::int64_t bias) {
  switch (array.output) {
  case spec::Output::projected:
    return row_sum(array, {weight[own]}, 0);
  case spec::Output::momentum:
    return row_sum(array, weight, 0);
  default:
    return row_sum(array, weight, bias);
  }
}

std::int64_t most_drive(const spec::ArraySpec& array) {
  const std::int64_t one = std::int64_t{1} << array.formats.drive.fraction_bits();
  return array.output == spec::Output::projected ? 2 * one : one;
}

std::int64_t unlimited_drive(const spec::ArraySpec& array, const spec::NumberFormat& accumulator,
                             std::int64_t s, Wide n) {
  const spec::NumberFormat& format = array.formats.drive;
  const std::int64_t most = most_drive(array), sign = s == 0 ? 0 : s > 0 ? 1 : -1;
  const bool steps = array.output == spec::Output::projected || array.output == spec::Output::momentum;
  if (array.output == spec::Output::binary || (steps && n == 0)) return sign * most;
  if (array.normaliser == spec::Normaliser::prescaled)
    return quantise_code(s, accumulator.fraction_bits(), format);
  if (n == 0) return 0;
  const Cut cut = array.normaliser == spec::Normaliser::divider ? divided(array, accumulator, s, n)
                                                                : multiplied(array, accumulator, s, n);
  return steps ? round_and_hold(cut, s < 0, format.rounding, most) : quantise(cut, s < 0, format);
}

std::int64_t drive(const spec::ArraySpec& array, const spec::NumberFormat& accumulator, std::int64_t s,
                   Wide n) {
  return held(unlimited_drive(array, accumulator, s, n), most_drive(array));
}

std::int64_t change(const spec::Formats& f, std::int64_t v, std::int64_t u) {
  const std::int64_t one = std::int64_t{1} << f.state.fraction_bits();
  const std::int64_t r = u >= 0 ? one - v : one + v;
  const __int128 product = multiply(r, u); // in units of 2^-(F_state + F_drive)
  const Cut cut = cut_bits(magnitude_of(product), f.drive.fraction_bits(), 0);
  return static_cast<std::int64_t>(
      wide_with_sign(round_cut(cut, product < 0, f.state.rounding), product < 0));
}

std::int64_t stepped(const spec::Formats& f, std::int64_t from, std::int64_t u) {
  const std::int64_t one = std::int64_t{1} << f.state.fraction_bits();
  return held(from + in_state_places(f, u, f.drive.fraction_bits()), one);
}

std::int64_t looked_ahead(const spec::Formats& f, std::int64_t after, std::int64_t moved, std::int64_t m) {
  const std::int64_t one = std::int64_t{1} << f.state.fraction_bits();
  const auto product = static_cast<std::int64_t>(multiply(moved, m));
  return held(
      after + in_state_places(f, product, f.state.fraction_bits() + spec::momentum_format.fraction_bits()),
      one);
}

std::int64_t link_code(const spec::Formats& f, std::int64_t v) {
  return quantise_code(v, f.state.fraction_bits(), f.link);
}

} // namespace hopmesh::tests
