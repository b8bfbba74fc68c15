// First part of a neuron: s = sum of weight * link + bias, and N = sum |weight| + |bias|
// (docs/hardware/datapath.md).
#pragma once

#include "rtl_model/systemc/datapath.h"

#include <systemc>
#include <vector>

namespace hopmesh::systemc {

/// Holds a row of weights and the bias, the accumulator register and N. Works a beat (`lanes` taps) at a
/// time, as the hardware does every cycle, or a whole row at once; both leave the same bits.
class InputAccumulator : public sc_core::sc_module {
 public:
  /// A row of `taps` inputs. The datapath is the array's and must outlive its neurons.
  InputAccumulator(sc_core::sc_module_name name, const Datapath& path, std::size_t taps);

  /// Wires of the next source, in the order of taps.
  void connect(const std::int32_t* source) { sources_.push_back(source); }

  std::size_t taps() const { return weights_.size(); }
  std::size_t beats() const { return (taps() + path_.lanes - 1) / path_.lanes; }

  void begin_sum();             ///< s <- bias
  void sum_beat(std::size_t k); ///< adds the k-th group of lanes
  void sum_row();               ///< begin_sum and every beat
  void begin_norm();            ///< N <- |bias|
  void norm_beat(std::size_t k);
  void norm_row();

  std::int64_t sum_raw() const { return sum_; }
  std::int64_t norm_raw() const { return norm_; }

  std::int32_t weight(std::size_t tap) const { return weights_[tap]; }
  std::int32_t bias() const { return bias_; }
  void set_weight(std::size_t tap, std::int32_t raw) { weights_[tap] = raw; }
  void set_bias(std::int32_t raw) { bias_ = raw; }

  void trace(sc_core::sc_trace_file* file) const override;

 private:
  std::int64_t dot(std::size_t first, std::size_t last) const;
  std::int64_t dot_row() const;
  void add(std::int64_t products);

  const Datapath& path_;
  std::vector<std::int32_t> weights_;
  std::vector<const std::int32_t*> sources_;
  std::int32_t bias_ = 0;
  std::int64_t sum_ = 0, norm_ = 0;
};

} // namespace hopmesh::systemc
