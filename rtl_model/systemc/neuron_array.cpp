#include "rtl_model/systemc/neuron_array.h"

#include "rtl_model/spec/signals.h"
#include "rtl_model/systemc/cellular_array.h"
#include "rtl_model/systemc/folded_array.h"

namespace hopmesh::systemc {

NeuronArray::NeuronArray(sc_core::sc_module_name name, const spec::ArraySpec& array,
                         const spec::Topology& topology)
    : sc_module(name), array_(array), topology_(topology),
      phases_(spec::phases_of(topology_, array_.schedule)),
      cycles_(spec::cycle_model(array_, topology_, phases_)), period_(1.0 / array.clock_mhz, sc_core::SC_US),
      detector("detector"),
      momentum("momentum",
               spec::has_momentum(array_) ? static_cast<std::size_t>(array_.momentum_entries) : 0),
      sequencer(spec::sequencer_signals::scope, cycles_, period_, detector, momentum),
      context_{array_,    topology_, Datapath(array_, topology_.most_taps(), topology_.neurons_per_cell),
               sequencer, detector,  momentum,
               extremes} {}

std::unique_ptr<NeuronArray> make_array(const char* name, const spec::ArraySpec& array,
                                        const spec::Topology& topology) {
  if (spec::is_folded(array)) return std::make_unique<FoldedArray>(name, array, topology);
  return std::make_unique<CellularArray>(name, array, topology);
}

} // namespace hopmesh::systemc
