// What the sequencer asks after the last phase of a sweep: what it came to over all neurons, and which m the
// next one takes.
#pragma once

#include "rtl_model/systemc/trace.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hopmesh::systemc {

/// The largest |V' - V|, the largest |s| of neurons that may still move, and whether momentum carried them
/// the wrong way.
class ConvergenceDetector : public sc_core::sc_module {
 public:
  explicit ConvergenceDetector(sc_core::sc_module_name name) : sc_module(name) {}

  /// `by_sum`: the comparators of |s| work; else they idle.
  void begin_run(bool by_sum) { by_sum_ = by_sum; }
  bool compares_sums() const { return by_sum_; }
  void begin_sweep() { largest_change_ = largest_sum_ = way_ = 0; }
  /// Of a neuron: s, V' - V, and whether s holds it at a bound.
  void report(std::int64_t sum, std::int64_t change, bool held) {
    const std::int64_t size = change < 0 ? -change : change;
    if (size > largest_change_) largest_change_ = size;
    way_ += sum > 0 ? change : sum < 0 ? -change : 0;
    if (!by_sum_ || held) return;
    const std::int64_t pull = sum < 0 ? -sum : sum;
    if (pull > largest_sum_) largest_sum_ = pull;
  }

  std::int64_t largest_change() const { return largest_change_; }
  std::int64_t largest_sum() const { return largest_sum_; } ///< 0 where the comparators idle
  /// Sum of sign(s) (V' - V): below zero where neurons went against what their sums asked for.
  std::int64_t way() const { return way_; }

 private:
  bool by_sum_ = false;
  std::int64_t largest_change_ = 0, largest_sum_ = 0, way_ = 0;
};

/// The table of m of a momentum array, and the counter that says which entry a sweep takes.
class MomentumTable : public sc_core::sc_module {
 public:
  /// No entries: the array has no table.
  MomentumTable(sc_core::sc_module_name name, std::size_t entries) : sc_module(name), codes_(entries, 0) {}

  bool exists() const { return !codes_.empty(); }
  std::int32_t code(std::size_t entry) const { return codes_[entry]; }
  void set_code(std::size_t entry, std::int32_t raw) { codes_[entry] = raw; }

  /// m of the sweep at hand; 0 where there is no table.
  std::int32_t now() const { return exists() ? codes_[entry_] : 0; }
  void begin_run() { entry_ = 0; }
  /// A restart takes this sweep for the first one. The last entry holds on.
  void end_sweep(bool restart) {
    const std::uint32_t taken = restart ? 0 : entry_;
    entry_ = std::min(taken + 1, static_cast<std::uint32_t>(codes_.size()) - 1);
  }

  /// The counter, as a signal of who reads it.
  void trace_entry(sc_core::sc_trace_file* file, const sc_core::sc_object& owner) const {
    if (exists()) trace_register(file, entry_, owner, spec::sequencer_signals::momentum);
  }

 private:
  std::vector<std::int32_t> codes_;
  std::uint32_t entry_ = 0;
};

} // namespace hopmesh::systemc
