#include "tests/bench/array_package.h"

#include "rtl_model/spec/points.h"

#include <stdexcept>

namespace hopmesh::bench {
namespace {

int bits_for(std::uint64_t largest) {
  int bits = 1;
  while (largest >> bits != 0) ++bits;
  return bits;
}

std::string number(const std::string& name, long long value) {
  return "  localparam int " + name + " = " + std::to_string(value) + ";\n";
}

/// Lines are broken, because Verilator takes only so many words in one.
template <typename T>
std::string table(const std::string& name, const std::vector<T>& values,
                  const char* type = "localparam int") {
  std::string text = std::string("  ") + type + " " + name + "[" + std::to_string(values.size()) + "] = '{";
  for (std::size_t k = 0; k < values.size(); ++k)
    text += (k == 0 ? "\n    " : k % 16 ? ", " : ",\n    ") + std::to_string(values[k]);
  return text + "};\n";
}

void expect(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("the Verilog models need ") + what);
}

/// Formats, and the places between their points.
std::string numbers(const spec::ArraySpec& array, std::size_t taps) {
  const spec::Formats f = spec::built_formats(array, taps);
  const spec::Points p = spec::points_of(f);
  const int norm_bits = bits_for((std::uint64_t{taps} << (f.weight.width - 1 + p.weight_up)) +
                                 (std::uint64_t{1} << (f.bias.width - 1 + p.bias_up)));
  expect(norm_bits < 32, "an N of less than 32 bits");
  expect(f.accumulator.width + array.reciprocal_bits <= 64, "a sum times a reciprocal in 64 bits");
  expect(p.ratio_up <= array.reciprocal_bits - 2, "no more fraction in the drive than the reciprocal gives");
  return number("WEIGHT_BITS", f.weight.width) + number("BIAS_BITS", f.bias.width) +
         number("DRIVE_BITS", f.drive.width) + number("DRIVE_FRACTION", f.drive.fraction_bits()) +
         number("DRIVE_ROUNDING", static_cast<int>(f.drive.rounding)) + number("STATE_BITS", f.state.width) +
         number("STATE_FRACTION", f.state.fraction_bits()) +
         number("STATE_ROUNDING", static_cast<int>(f.state.rounding)) + number("LINK_BITS", f.link.width) +
         number("LINK_FRACTION", f.link.fraction_bits()) +
         number("LINK_ROUNDING", static_cast<int>(f.link.rounding)) +
         number("ACCUMULATOR_BITS", f.accumulator.width) + number("PRODUCT_UP", p.product_up) +
         number("BIAS_UP", -p.bias_down) + number("NORM_BITS", norm_bits) +
         number("WEIGHT_NORM_UP", p.weight_up) + number("BIAS_NORM_UP", p.bias_up) +
         number("RECIPROCAL_BITS", array.reciprocal_bits) + number("RATIO_UP", p.ratio_up);
}

/// The mesh: where each neuron's row begins, in which phase it fires, which neurons its taps come from.
std::string tables(const spec::Topology& t, const spec::Phases& phases) {
  const std::size_t per_cell = t.neurons_per_cell;
  std::vector<std::size_t> rows, taps, sources, longest;
  for (std::size_t i = 0; i < t.neurons(); ++i) {
    const std::size_t cell = i / per_cell;
    rows.push_back(t.row_offset(cell, i % per_cell));
    taps.push_back(t.taps(cell));
    for (std::size_t q = 0; q < per_cell; ++q) sources.push_back(cell * per_cell + q);
    for (std::size_t k = t.first_link[cell]; k < t.first_link[cell + 1]; ++k)
      for (std::size_t q = 0; q < per_cell; ++q) sources.push_back(t.link_to[k] * per_cell + q);
  }
  for (const auto& neurons : phases) {
    longest.push_back(0);
    for (std::uint32_t i : neurons) longest.back() = std::max(longest.back(), t.taps(i / per_cell));
  }
  return table("ROW_OF", rows) + table("TAPS_OF", taps) +
         table("TAP_SOURCE", sources, "localparam logic [$clog2(NEURONS)-1:0]") +
         table("PHASE_OF", spec::phase_of_neurons(t, phases)) + table("PHASE_TAPS", longest);
}

} // namespace

std::string array_package(const spec::ArraySpec& array, const spec::Topology& topology, Capacity capacity) {
  expect(array.lanes == 1, "one lane");
  expect(array.normaliser == spec::Normaliser::reciprocal, "the normaliser `reciprocal`");
  expect(array.exact_accumulator, "an exact accumulator");
  const spec::Phases phases = spec::phases_of(topology, array.schedule);
  std::size_t elements = capacity.elements;
  for (const auto& neurons : phases) elements = std::max(elements, neurons.size());
  const std::size_t taps = std::max(capacity.taps, topology.most_taps()),
                    most_phases = std::max(capacity.phases, phases.size());
  return "// Written by write_array_package from rtl_model/spec.\npackage array_pkg;\n" +
         numbers(array, taps) + number("NEURONS", topology.neurons()) + number("PHASES", phases.size()) +
         number("ELEMENTS", elements) + number("TAPS", taps) + number("MOST_TAPS", topology.most_taps()) +
         number("PHASE_BITS", bits_for(most_phases - 1)) +
         number("BEAT_BITS", bits_for(std::max<std::size_t>(taps, array.reciprocal_bits))) +
         tables(topology, phases) + "endpackage\n";
}

} // namespace hopmesh::bench
