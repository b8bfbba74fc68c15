// Second part of a neuron: u = s / N, or sign(s) where outputs are binary; R = 1 - V or 1 + V, V <- V + R u.
// Or u is the step itself, held in the box, from V (projected) or from Y (momentum)
// (docs/hardware/datapath.md).
#pragma once

#include "rtl_model/systemc/datapath.h"
#include "rtl_model/systemc/rounding.h"

#include <systemc>
#include <vector>

namespace hopmesh::systemc {

/// Holds V, Y and N of its neurons, one or more, and the registers u and delta on the way to a new V. Knows
/// nothing of neighbours. A neuron's place is its number among those of this stage.
class OutputStage : public sc_core::sc_module {
 public:
  /// The datapath is the array's and must outlive its neurons.
  OutputStage(sc_core::sc_module_name name, const Datapath& path, std::size_t neurons = 1);

  /// Once a run; for `reciprocal` this is where the reciprocal is divided.
  void set_norm(std::int64_t norm_raw, std::size_t place = 0);
  void normalise(std::int64_t sum_raw, std::size_t place = 0); ///< u <- limited Q[s / N], or sign(s)
  /// delta <- Q[R u], where the R bias pulls V to the bound that u points to; or the way from V to where u
  /// leads. Of a u that has left its register: as it was there.
  void find_change(std::int64_t drive_raw, std::size_t place = 0);
  /// Does s push the neuron to the bound at which its link shows it? Asked before it is published.
  bool is_held(std::int64_t sum_raw, std::size_t place = 0) const;
  /// V <- V + delta, and Y as far ahead of it as m says; returns delta.
  std::int64_t publish(std::size_t place = 0, std::int64_t momentum_raw = 0);
  void settle(std::size_t place = 0);                                 ///< Y <- V
  void extrapolate(std::int32_t raw) { memory_->extrapolated = raw; } ///< Y of a neuron laid open

  std::int64_t state_raw(std::size_t place = 0) const { return memory_[place].state; }
  std::int64_t ratio_raw() const { return ratio_; } ///< u before the limiter
  std::int64_t drive_raw() const { return drive_; }
  std::int64_t pull_raw() const { return pull_; }       ///< R
  std::int64_t product_raw() const { return product_; } ///< R u, or m delta
  std::int64_t extrapolated_raw(std::size_t place = 0) const { return memory_[place].extrapolated; } ///< Y
  std::int64_t change_raw() const { return delta_; }
  /// Of the last N that was not zero.
  std::int64_t reciprocal_raw(std::size_t place = 0) const { return memory_[place].reciprocal; }
  /// s r * 2^-places counts in the drive's place.
  int reciprocal_places(std::size_t place = 0) const { return memory_[place].reciprocal_places; }
  std::int32_t link_raw(std::size_t place = 0) const; ///< Q[V -> link], of Y with momentum
  /// A value from the host: cut to the format's width, then held within [-1, 1].
  void load(std::int32_t raw, std::size_t place = 0);

  void trace(sc_core::sc_trace_file* file) const override; ///< u and delta
  /// V, as a signal of `scope`, and Y where it counts.
  void trace_state(sc_core::sc_trace_file* file, const std::string& scope, std::size_t place = 0) const;

 private:
  struct Memory {
    std::int64_t norm = 0, reciprocal = 0, state = 0, extrapolated = 0;
    int reciprocal_places = 0;
  };

  Wide exact_ratio(std::int64_t sum_raw, std::int64_t norm) const;
  Wide ratio_of(std::int64_t sum_raw, const Memory& of) const;
  /// Where the step begins, and what the link shows.
  std::int64_t Memory::*base() const { return has_momentum_ ? &Memory::extrapolated : &Memory::state; }

  const Datapath& path_;
  const bool has_momentum_;
  std::int64_t ratio_ = 0, drive_ = 0, pull_ = 0, product_ = 0, delta_ = 0;
  Memory only_; ///< of a stage that has a single neuron: beside its registers
  std::vector<Memory> many_;
  Memory* const memory_; ///< one or the other, by place
};

} // namespace hopmesh::systemc
