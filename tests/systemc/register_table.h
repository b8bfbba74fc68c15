// The register table of firmware/registers.h as rows that a test can walk, and a small array to ask.
#pragma once

#include "rtl_model/spec/presets.h"
#include "tests/support/dut_job.h"
#include "tests/support/random_network.h"

#include <string>
#include <vector>

namespace hopmesh::tests {

enum class Access { RO, RW, WO, W1C };

struct RegisterRow {
  std::string name;
  std::uint32_t offset = 0;
  Access access = Access::RO;
  std::uint32_t reset = 0;

  bool capability() const { return name.rfind("CAP_", 0) == 0; }
  /// Counts while anybody looks: never the same twice.
  bool counts_transfers() const { return name.rfind("BUS_CYCLES", 0) == 0; }
};

inline std::vector<RegisterRow> register_rows() {
  std::vector<RegisterRow> rows;
#define HM_X(name, offset, access, reset_value, meaning)                                                     \
  rows.push_back({#name, offset, Access::access, reset_value});
  HM_REGISTERS(HM_X)
#undef HM_X
  return rows;
}

struct WindowRow {
  std::string name;
  bool writable = false;
  std::uint64_t codes = 0;
  int width = 32; ///< of a code
  std::uint64_t words = 0;
  std::uint32_t base = 0; ///< 0: of no words
};

/// The map by the page's rule: each window takes the least power of two that holds its words, at a multiple
/// of that.
inline std::vector<WindowRow> window_rows(const spec::Topology& t, const spec::ArraySpec& a) {
  std::vector<WindowRow> rows;
#define HM_X(name, access, meaning) rows.push_back({#name, Access::access == Access::RW});
  HM_WINDOWS(HM_X)
#undef HM_X
  std::uint64_t end = 0x1000;
  for (WindowRow& row : rows) {
    if (row.name == "FIRST_LINK") row.codes = t.cells() + 1;
    if (row.name == "LINK") row.codes = t.link_to.size();
    if (row.name == "BIAS" || row.name == "OUTPUT") row.codes = t.cells() * t.neurons_per_cell;
    if (row.name == "BIAS") row.width = a.formats.bias.width;
    if (row.name == "OUTPUT") row.width = a.formats.state.width;
    if (row.name == "WEIGHT") row.width = a.formats.weight.width;
    if (row.name == "MOMENTUM") row.width = 16;
    if (row.name == "MOMENTUM" && a.output == spec::Output::momentum) row.codes = a.momentum_entries;
    if (row.name == "WEIGHT")
      for (std::size_t c = 0; c < t.cells(); ++c) row.codes += t.neurons_per_cell * t.taps(c);
    const std::uint64_t share = !a.packing || row.width > 16 ? 1 : row.width > 8 ? 2 : 4;
    row.words = row.codes / share + (row.codes % share > 0);
    if (row.words == 0) continue;
    std::uint64_t room = 1;
    while (room < 4 * row.words) room *= 2;
    while (end % room != 0) ++end;
    row.base = static_cast<std::uint32_t>(end);
    end += room;
  }
  return rows;
}

/// A device of four cells in a ring, on a bus of `bus_bits`.
inline spec::ArraySpec small_array(int bus_bits = 32) {
  spec::ArraySpec a = spec::descent_array();
  a.bus_bits = bus_bits;
  return a;
}

/// Weights, biases and outputs that keep moving for many sweeps.
inline ArrayJob lively_job(std::uint64_t seed, const spec::ArraySpec& array, const spec::Topology& topology) {
  Dice dice(seed);
  ArrayJob job = random_codes(dice, array, topology);
  for (auto& w : job.weight)
    w = static_cast<std::int32_t>(
        dice.between(array.formats.weight.min_raw() / 2, array.formats.weight.max_raw() / 2));
  for (auto& b : job.bias)
    b = static_cast<std::int32_t>(
        dice.between(array.formats.bias.min_raw() / 64, array.formats.bias.max_raw() / 64));
  const std::int64_t one = array.formats.state.one_raw();
  for (auto& v : job.start) v = static_cast<std::int32_t>(dice.between(-one / 2, one / 2));
  for (std::size_t k = 0; k < cosim::table_entries(array); ++k)
    job.momentum.push_back(static_cast<std::int32_t>(dice.between(-16000, 32767)));
  job.threshold = 0;
  job.max_sweeps = 3;
  return job;
}

} // namespace hopmesh::tests
