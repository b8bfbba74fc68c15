// The slow, obvious oracle of number formats: what a number known exactly becomes in a format, bit by bit.
// Shares only the names and ranges of rtl_model/spec with the models it judges.
#pragma once

#include "rtl_model/spec/number_format.h"

namespace hopmesh::tests {

/// Room for every exact number that a valid array meets; magnitudes only, signs go beside.
using Wide = unsigned __int128;

/// A magnitude cut at a format's last place: the whole places, and what lies behind the cut.
struct Cut {
  Wide whole = 0;      ///< places kept, as far as they fit
  bool beyond = false; ///< there are set bits above `whole`
  bool half = false;   ///< the first bit behind the cut
  bool rest = false;   ///< any bit behind that one
};

/// Cuts magnitude * 2^-fraction at 2^-kept_fraction. Either fraction may be negative or large.
Cut cut_bits(Wide magnitude, int fraction, int kept_fraction);
/// Cuts the quotient at 1, by restoring division, one bit at a time. The denominator stays below 2^126.
Cut cut_quotient(Wide numerator, Wide denominator);

/// Rounding alone: the magnitude's code, of no format yet.
Wide round_cut(const Cut& cut, bool negative, spec::Rounding mode);
/// Overflow alone: the code that a format makes of a whole number of last places.
std::int64_t bring_into_range(Wide magnitude, bool beyond, bool negative, const spec::NumberFormat& format);
/// Q[ ] of docs/hardware/datapath.md: rounding, then overflow.
std::int64_t quantise(const Cut& cut, bool negative, const spec::NumberFormat& format);

/// Q[code * 2^-fraction -> format]
std::int64_t quantise_code(__int128 code, int fraction, const spec::NumberFormat& format);
/// Q[value * 2^shift -> format] of a finite double, from its bits.
std::int64_t quantise_double(double value, int shift, const spec::NumberFormat& format);

inline Wide magnitude_of(__int128 x) {
  return x < 0 ? -static_cast<Wide>(x) : static_cast<Wide>(x);
}

} // namespace hopmesh::tests
