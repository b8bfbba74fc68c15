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

/// Code k of words that hold `codes_a_word` codes each, sign extended.
inline std::int32_t code_in(const std::uint32_t* words, int codes_a_word, std::size_t k) {
  const auto n = static_cast<std::size_t>(codes_a_word);
  const int bits = 32 / codes_a_word, above = 32 - bits * static_cast<int>(k % n + 1);
  return static_cast<std::int32_t>(words[k / n] << above) >> (32 - bits);
}

/// Words that hold the codes, `codes_a_word` each.
inline std::vector<std::uint32_t> packed(const Codes& codes, int codes_a_word) {
  const auto n = static_cast<std::size_t>(codes_a_word);
  if (n == 1) return {codes.begin(), codes.end()};
  const int bits = 32 / codes_a_word;
  std::vector<std::uint32_t> words((codes.size() + n - 1) / n, 0);
  for (std::size_t k = 0; k < codes.size(); ++k)
    words[k / n] |= (static_cast<std::uint32_t>(codes[k]) & ((1u << bits) - 1))
                    << bits * static_cast<int>(k % n);
  return words;
}

} // namespace hopmesh::levels
