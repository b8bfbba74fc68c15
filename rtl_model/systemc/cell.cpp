#include "rtl_model/systemc/cell.h"

#include "rtl_model/spec/signals.h"

namespace hopmesh::systemc {

Cell::Cell(sc_core::sc_module_name name, const ArrayContext& context, std::size_t index,
           const std::vector<std::size_t>& phases)
    : sc_module(name), out("out"), in("in", context.topology.degree(index)), link_("link") {
  out.bind(link_);
  const std::size_t taps = context.topology.taps(index);
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const std::string neuron = spec::neuron_scope(p);
    neurons_.push_back(std::make_unique<Neuron>(neuron.c_str(), context, phases[p], taps, link_, p));
  }
}

// Ports are bound now: read through plain wires from here on (SystemC's port access costs half the time of a
// row).
void Cell::end_of_elaboration() {
  for (auto& neuron : neurons_) {
    neuron->accumulator.connect(link_.wires());
    for (const auto& port : in) neuron->accumulator.connect(port->wires());
  }
}

void Cell::trace(sc_core::sc_trace_file* file) const {
  for (const auto& neuron : neurons_) neuron->trace(file);
}

} // namespace hopmesh::systemc
