// An output stage that neurons walk through register by register, with the memories of its neurons: of one
// element, or of all.
#pragma once

#include "rtl_model/systemc/link_memory.h"
#include "rtl_model/systemc/neuron_array.h"
#include "rtl_model/systemc/output_stage.h"

#include <deque>

namespace hopmesh::systemc {

/// A neuron's place is its number among those of the stage. By clock, `clock` comes first in every cycle,
/// then `take`. By phase, each neuron goes the whole way at once: `fire`, or `put_sum` where elements share
/// the stage.
class PipelinedStage : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(PipelinedStage);
  /// `neurons`: those of each place.
  PipelinedStage(sc_core::sc_module_name name, const ArrayContext& context, LinkMemory& links,
                 const std::vector<std::uint32_t>& neurons);

  OutputStage output;

  /// Everybody inside goes on by a register.
  void clock();
  /// A sum, or N, goes into the first register.
  void take_sum(std::size_t place, std::int64_t sum_raw) { enter({place, sum_raw, false, 0, 0}); }
  void take_norm(std::size_t place, std::int64_t norm_raw) { enter({place, norm_raw, true, 0, 0}); }
  bool empty() const { return inside_.empty(); }

  void fire(std::size_t place, std::int64_t sum_raw);
  /// All that are put at one time fire when all have been put, in the order of their places, which follow
  /// each other without a gap.
  void put_sum(std::size_t place, std::int64_t sum_raw);
  void trace(sc_core::sc_trace_file* file) const override;

 private:
  /// What a neuron carries from register to register, and how many it has passed.
  struct Passenger {
    std::size_t place;
    std::int64_t value; ///< s or N
    bool is_norm;
    std::int64_t drive;
    std::uint64_t passed;
  };

  void fire_all();
  void enter(Passenger passenger);
  /// True where it has come out.
  bool pass(Passenger& passenger);
  void normalise(std::size_t place, std::int64_t sum_raw);
  void publish(std::size_t place, std::int64_t sum_raw);
  void settle_all();

  const ArrayContext& context_;
  LinkMemory& links_;
  const std::vector<std::uint32_t> neurons_;
  const std::uint64_t drive_cycles_, change_cycles_, stage_cycles_, norm_cycles_;
  std::deque<Passenger> inside_;   ///< oldest first
  std::uint32_t shown_ = 0;        ///< the neuron of u
  std::vector<std::int64_t> sums_; ///< that were put, by place
  std::size_t first_put_ = SIZE_MAX, last_put_ = 0;
  sc_core::sc_event all_put_;
};

} // namespace hopmesh::systemc
