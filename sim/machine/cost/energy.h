// The energy of a step: how often each part works, times what that takes. Two prices: OSU's 0.18 um cells as
// OpenSTA weighs them, and a published table for 45 nm (docs/findings/cost.md tells its source).
#pragma once

#include "sim/machine/cost/cost_points.h"
#include "sim/machine/cost/memory_blocks.h"
#include "sim/machine/timeline.h"

namespace hopmesh::machine {

/// Which share of input bits changes from one cycle of work to the next; counted on a network.
struct Toggles {
  double weights = 0.5, links = 0.5; ///< as of numbers at random
};

/// What a run of sweeps comes to.
struct Activity {
  double products = 0;   ///< w L, and |w| of prepare
  double firings = 0;    ///< of neurons, and norms of prepare
  double cycles = 0;     ///< of the array
  double all_cycles = 0; ///< with those of the bus
  double bus_words = 0;
  double read_bits = 0, written_bits = 0; ///< of memories, by what goes over their ports
  double table_bits = 0;                  ///< read
  double access_pj = 0;                   ///< of these by the published table
};
Activity activity_of(const spec::ArraySpec& array, const spec::Topology& topology, const Work& work,
                     std::uint64_t runs);

struct Energy {
  double clock = 0;      ///< registers whose clock goes on though nothing changes
  double arithmetic = 0; ///< elements and stages that work
  double memory = 0, bus = 0;

  double total() const { return clock + arithmetic + memory + bus; }
};
/// Joules of OSU's cells, `parts` as measured or predicted; memories and bus by the table, scaled to 0.18 um
/// and 1.8 V.
Energy silicon_energy(const Activity& activity, const CostPoint& parts, const Toggles& toggles);
/// Joules by the published table: operations, memories and nothing else.
Energy table_energy(const Activity& activity, const Parameters& parameters);

} // namespace hopmesh::machine
