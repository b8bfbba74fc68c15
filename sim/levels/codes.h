// Raw codes of an array, and the numbers that they stand for.
#pragma once

#include "firmware/quantise.h"

#include <vector>

namespace hopmesh::levels {

using Codes = std::vector<std::int32_t>;

/// What a code of 1 stands for.
inline double last_place(const hm_format& format) {
  return hm_power_of_two(-hm_fraction_bits(&format));
}

inline std::vector<double> to_doubles(const Codes& codes, double place) {
  std::vector<double> values(codes.begin(), codes.end());
  for (double& value : values) value *= place;
  return values;
}

/// Rounded and held within the format, as the driver loads them.
inline Codes to_codes(const std::vector<double>& values, const hm_format& format) {
  Codes codes(values.size());
  hm_codes(values.data(), static_cast<std::uint32_t>(values.size()),
           hm_power_of_two(hm_fraction_bits(&format)), &format,
           reinterpret_cast<std::uint32_t*>(codes.data()));
  return codes;
}

} // namespace hopmesh::levels
