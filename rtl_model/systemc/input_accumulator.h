// First part of a neuron: s = sum of weight * link + bias, and what divides s: N = sum |weight| + |bias|, or
// what the output stage wants instead (docs/hardware/datapath.md).
#pragma once

#include "rtl_model/systemc/datapath.h"

#include <systemc>
#include <vector>

namespace hopmesh::systemc {

/// Holds rows of weights and their biases, the accumulator register and N. Works on the selected row: a beat
/// (`lanes` taps) at a time, as the hardware does every cycle, or the whole row at once; both leave the same
/// bits.
class InputAccumulator : public sc_core::sc_module {
 public:
  /// Rows of so many inputs; the first is selected. The datapath is the array's and must outlive its neurons.
  InputAccumulator(sc_core::sc_module_name name, const Datapath& path, const std::vector<std::size_t>& taps);

  /// Wires of the row's next source, in the order of taps.
  void connect(const std::int32_t* source, std::size_t row = 0) {
    rows_[row].sources[rows_[row].connected++] = source;
  }
  /// Which tap of the row has the neuron itself as its source.
  void set_own_tap(std::size_t tap, std::size_t row = 0) {
    rows_[row].own = tap;
    if (row == selected_) at_.own = tap;
  }
  /// `bank`: places from the wires as connected to those that are read, where links have banks.
  void select(std::size_t row, std::ptrdiff_t bank = 0) {
    const Row& r = rows_[row];
    at_ = {r.weights.data(),
           r.sources.data(),
           r.sources.data() + r.sources.size(),
           r.weights.size(),
           r.own,
           r.bias};
    selected_ = row;
    bank_ = bank;
  }

  std::size_t taps() const { return at_.taps; }
  std::size_t beats() const { return (taps() + path_.lanes - 1) / path_.lanes; }

  void begin_sum();             ///< s <- bias
  void sum_beat(std::size_t k); ///< adds the k-th group of lanes
  void sum_row();               ///< begin_sum and every beat
  void begin_norm();            ///< N <- |bias|, or 0 where no bias counts
  void norm_beat(std::size_t k);
  void norm_row();

  std::int64_t sum_raw() const { return sum_; }
  std::int64_t norm_raw() const { return norm_; }

  std::int32_t weight(std::size_t tap, std::size_t row = 0) const { return rows_[row].weights[tap]; }
  std::int32_t bias(std::size_t row = 0) const { return rows_[row].bias; }
  void set_weight(std::size_t tap, std::int32_t raw, std::size_t row = 0) { rows_[row].weights[tap] = raw; }
  void set_bias(std::int32_t raw, std::size_t row = 0) {
    rows_[row].bias = raw;
    if (row == selected_) at_.bias = raw;
  }

  void trace(sc_core::sc_trace_file* file) const override;

 private:
  struct Row {
    std::vector<std::int32_t> weights;
    std::vector<const std::int32_t*> sources;
    std::size_t connected = 0; ///< sources so far
    std::size_t own = 0;
    std::int32_t bias = 0;
  };

  std::int64_t dot(std::size_t first, std::size_t last) const;
  std::int64_t dot_row() const;
  void add(std::int64_t products);

  const Datapath& path_;
  /// The selected row, at hand: what it is made of lies elsewhere.
  struct {
    const std::int32_t* weights;
    const std::int32_t *const *sources, *const *sources_end;
    std::size_t taps, own;
    std::int32_t bias;
  } at_;
  std::ptrdiff_t bank_ = 0;
  std::int64_t sum_ = 0, norm_ = 0;
  std::size_t selected_ = 0;
  std::vector<Row> rows_;
};

} // namespace hopmesh::systemc
