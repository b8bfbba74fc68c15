// Second part of a neuron: u = s / N, or sign(s) where outputs are binary; R = 1 - V or 1 + V, V <- V + R u
// (docs/hardware/datapath.md).
#pragma once

#include "rtl_model/systemc/datapath.h"
#include "rtl_model/systemc/rounding.h"

#include <systemc>

namespace hopmesh::systemc {

/// Holds V, and the registers u and delta on the way to it. Knows nothing of neighbours.
class OutputStage : public sc_core::sc_module {
 public:
  /// The datapath is the array's and must outlive its neurons.
  OutputStage(sc_core::sc_module_name name, const Datapath& path);

  void
  set_norm(std::int64_t norm_raw); ///< once a run; for `reciprocal` this is where the reciprocal is divided
  void normalise(std::int64_t sum_raw); ///< u <- limited Q[s / N], or sign(s)
  void bias_by_r();                     ///< delta <- Q[R u]: the R bias pulls V to the bound that u points to
  std::int64_t publish();               ///< V <- V + delta; returns |delta|

  std::int64_t state_raw() const { return state_; }
  std::int64_t ratio_raw() const { return ratio_; } ///< u before the limiter
  std::int64_t drive_raw() const { return drive_; }
  std::int64_t pull_raw() const { return pull_; }             ///< R
  std::int64_t product_raw() const { return pull_ * drive_; } ///< R u
  std::int64_t change_raw() const { return delta_; }
  std::int64_t reciprocal_raw() const { return reciprocal_; } ///< of the last N that was not zero
  int reciprocal_places() const {
    return reciprocal_places_;
  }                              ///< s r * 2^-places counts in the drive's place
  std::int32_t link_raw() const; ///< Q[V -> link]
  /// A value from the host: cut to the format's width, then held within [-1, 1].
  void load(std::int32_t raw);

  void trace(sc_core::sc_trace_file* file) const override;

 private:
  Wide exact_ratio(std::int64_t sum_raw) const;

  const Datapath& path_;
  std::int64_t norm_ = 0, reciprocal_ = 0, ratio_ = 0, drive_ = 0, pull_ = 0, delta_ = 0, state_ = 0;
  int reciprocal_places_ = 0;
};

} // namespace hopmesh::systemc
