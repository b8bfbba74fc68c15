#include "rtl_model/systemc/cellular_array.h"

#include "rtl_model/spec/signals.h"

namespace hopmesh::systemc {

CellularArray::CellularArray(sc_core::sc_module_name name, const spec::ArraySpec& array,
                             const spec::Topology& topology)
    : sc_module(name), array_(array), topology_(topology),
      phases_(spec::phases_of(topology_, array_.schedule)),
      cycles_(spec::cycle_model(array_, topology_, phases_)), period_(1.0 / array.clock_mhz, sc_core::SC_US),
      detector("detector"), sequencer(spec::sequencer_signals::scope, cycles_, period_, detector),
      context_{array_,    topology_, Datapath(array_, topology_.most_taps(), topology_.neurons_per_cell),
               sequencer, detector,  extremes} {
  const auto phase = spec::phase_of_neurons(topology_, phases_);
  const std::size_t per_cell = topology_.neurons_per_cell;
  for (std::size_t c = 0; c < topology_.cells(); ++c) {
    const std::string cell = spec::cell_scope(c);
    cells_.push_back(std::make_unique<Cell>(
        cell.c_str(), context_, c,
        std::vector<std::size_t>(phase.begin() + c * per_cell, phase.begin() + (c + 1) * per_cell)));
  }
  wire_links();
}

// SystemC finds a port that goes by a search from the newest on: the other way round large arrays would take
// minutes to end.
CellularArray::~CellularArray() {
  while (!cells_.empty()) cells_.pop_back();
}

void CellularArray::wire_links() {
  for (std::size_t c = 0; c < topology_.cells(); ++c)
    for (std::size_t k = 0; k < topology_.degree(c); ++k)
      cells_[c]->in[k].bind(cells_[topology_.link_to[topology_.first_link[c] + k]]->out);
}

} // namespace hopmesh::systemc
