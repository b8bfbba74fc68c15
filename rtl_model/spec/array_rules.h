// Which arrays can be built.
#pragma once

#include "rtl_model/spec/array_keys.h"

namespace hopmesh::spec {

/// Far above what an array is built for, far below what fills a machine's memory by a slip of the pen.
inline constexpr std::int64_t most_cells = 4'000'000;

/// A rule that an array broke: the key as scene and array files write it, what stands there, what should.
struct SpecFault {
  std::string key, found, expected;
};

namespace detail {

inline std::optional<SpecFault> format_fault(const SignalClass& signal, const NumberFormat& f) {
  const std::string key = std::string("formats.") + signal.name;
  if (f.width < least_width || f.width > most_width)
    return SpecFault{key, f.text(), from_to(least_width, most_width) + " bits"};
  if (f.integer_bits < signal.least_integer_bits || f.integer_bits >= f.width)
    return SpecFault{key, f.text(),
                     "from " + std::to_string(signal.least_integer_bits) +
                         " integer bits to one less than the width" +
                         (signal.least_integer_bits == 2 ? " (+1 needs two)" : "")};
  return std::nullopt;
}

inline std::optional<SpecFault> accumulator_fault(const ArraySpec& a, std::size_t taps) {
  const NumberFormat exact = exact_accumulator_format(a.formats, taps);
  if (exact.width > most_sum_width)
    return SpecFault{"formats.weight", a.formats.weight.text(),
                     "formats whose exact sum fits " + std::to_string(most_sum_width) +
                         " bits (this one needs " + std::to_string(exact.width) + " for rows of " +
                         std::to_string(taps) + " inputs)"};
  if (a.exact_accumulator) return std::nullopt;
  const NumberFormat& f = a.formats.accumulator;
  if (f.width < least_width || f.width > most_sum_width || f.integer_bits < 1 || f.fraction_bits() < 0)
    return SpecFault{"formats.accumulator", f.text(),
                     from_to(least_width, most_sum_width) + " bits, at least 1 of them before the point"};
  if (f.fraction_bits() > exact.fraction_bits())
    return SpecFault{"formats.accumulator", f.text(),
                     "at most the " + std::to_string(exact.fraction_bits()) + " fraction bits of a product"};
  return std::nullopt;
}

inline std::optional<SpecFault> formats_fault(const ArraySpec& a, std::size_t taps) {
  const Formats& f = a.formats;
  for (const SignalClass& signal : signal_classes)
    if (signal.format != &Formats::accumulator)
      if (auto fault = format_fault(signal, f.*signal.format)) return fault;
  if (f.link.fraction_bits() > f.state.fraction_bits())
    return SpecFault{"formats.link", f.link.text(),
                     "at most the state's " + std::to_string(f.state.fraction_bits()) + " fraction bits"};
  return accumulator_fault(a, taps);
}

/// Where the registers of a pipeline find no place. What is below zero is told by the key's own range.
inline std::optional<SpecFault> pipeline_fault(const ArraySpec& a) {
  const int most = most_pipeline(a);
  if (a.pipeline <= most) return std::nullopt;
  const std::string stage = a.output == Output::modified
                                ? "the normaliser " + std::string(name_of(a.normaliser))
                                : std::string(name_of(a.output)) + " outputs";
  return SpecFault{"array.pipeline", std::to_string(a.pipeline),
                   (most == 0 ? "0" : from_to(0, most)) + " with " + stage};
}

/// What an output stage wants of the rest of the array.
inline std::optional<SpecFault> output_fault(const ArraySpec& a) {
  if (a.output != Output::projected && a.output != Output::momentum) return std::nullopt;
  const std::string with = " with array.output = \"" + std::string(name_of(a.output)) + "\"";
  const auto text = [](auto mode) { return '"' + std::string(name_of(mode)) + '"'; };
  if (a.output == Output::momentum && a.schedule != Schedule::synchronous)
    return SpecFault{"array.schedule", text(a.schedule),
                     "\"synchronous\"" + with + ": momentum fires all neurons at once"};
  if (a.output == Output::projected && a.schedule == Schedule::synchronous)
    return SpecFault{"array.schedule", text(a.schedule),
                     "\"coloured\" or \"sequential\"" + with + ": neurons that share a weight fire in turn"};
  if (a.normaliser == Normaliser::prescaled)
    return SpecFault{"array.normaliser", text(a.normaliser),
                     "\"reciprocal\" or \"divider\"" + with + ": prescaled rows are not symmetric"};
  return std::nullopt;
}

} // namespace detail

/// Nothing if the array can be built for rows of at most `taps` inputs, else the first rule it breaks.
inline std::optional<SpecFault> validate(const ArraySpec& a, std::size_t taps = 1,
                                         ArrayTable table = array_keys) {
  if (auto fault = detail::formats_fault(a, taps)) return fault;
  ArraySpec copy = a;
  for (const ArrayKey& key : table(copy))
    if (!key.allowed.takes(key.place)) return SpecFault{key.name, key.value(), key.allowed.words};
  if (auto fault = detail::output_fault(a)) return fault;
  return detail::pipeline_fault(a);
}

/// As validate(), for a mesh or network: with its longest row, and the room that its windows take.
inline std::optional<SpecFault> validate_on(const ArraySpec& a, const Topology& t) {
  if (auto fault = validate(a, t.most_taps())) return fault;
  const std::uint64_t span = memory_map(a, t).span;
  if (span <= most_span) return std::nullopt;
  return SpecFault{"array.packing", std::to_string(span >> 30) + " GiB of registers and windows",
                   "at most 4, which 32 address bits reach: a smaller network, or codes that share words"};
}

} // namespace hopmesh::spec
