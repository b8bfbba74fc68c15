// What can be built, key by key; rules that reach across keys are in array_rules.h.
#pragma once

#include "rtl_model/spec/key_row.h"

namespace hopmesh::spec {

inline constexpr int least_width = 4, most_width = 32; ///< of every format but the accumulator's
inline constexpr int most_sum_width = 62;              ///< of the accumulator, exact or not
inline constexpr int least_reciprocal_bits = 4, most_reciprocal_bits = 32;
inline constexpr int most_lanes = 64;
inline constexpr int most_relaxation = 31; ///< sixteenths: less than 2
inline constexpr int most_momentum_entries = 4096;
inline constexpr int most_elements = 4096;
/// Registers of a pipeline; most_pipeline knows how many a normaliser can have.
inline constexpr int most_registers = 4;
inline constexpr std::array<int, 3> bus_widths{32, 64, 128}; ///< of the host bus
inline constexpr double most_mhz = 10000;

namespace detail {

inline std::string from_to(int least, int most) {
  return std::to_string(least) + " to " + std::to_string(most);
}

inline Allowed numbers(int least, int most) {
  return {from_to(least, most), double(least), double(most)};
}

inline Allowed bits(const SignalClass& signal) {
  if (signal.format == &Formats::accumulator)
    return {"`\"exact\"`, or " + from_to(least_width, most_sum_width) + " bits, no finer than a product"};
  return {from_to(least_width, most_width) + " bits, " + std::to_string(signal.least_integer_bits) +
          " or more before the point"};
}

} // namespace detail

} // namespace hopmesh::spec
