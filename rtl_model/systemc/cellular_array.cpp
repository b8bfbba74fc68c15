#include "rtl_model/systemc/cellular_array.h"

#include "rtl_model/spec/signals.h"

namespace hopmesh::systemc {

CellularArray::CellularArray(sc_core::sc_module_name name, const spec::ArraySpec& array,
                             const spec::Topology& topology)
    : NeuronArray(name, array, topology) {
  const spec::Topology& t = this->topology(); // the array's own, which outlives this call
  const auto phase = spec::phase_of_neurons(t, phases());
  const auto per_cell = static_cast<std::size_t>(t.neurons_per_cell);
  for (std::size_t c = 0; c < t.cells(); ++c) {
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
  const spec::Topology& t = topology();
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = 0; k < t.degree(c); ++k)
      cells_[c]->in[k].bind(cells_[t.link_to[t.first_link[c] + k]]->out);
}

std::int32_t CellularArray::weight(std::size_t k, std::size_t tap) const {
  return neuron(k).accumulator.weight(tap);
}
void CellularArray::set_weight(std::size_t k, std::size_t tap, std::int32_t raw) {
  neuron(k).accumulator.set_weight(tap, raw);
}
std::int32_t CellularArray::bias(std::size_t k) const {
  return neuron(k).accumulator.bias();
}
void CellularArray::set_bias(std::size_t k, std::int32_t raw) {
  neuron(k).accumulator.set_bias(raw);
}
std::int64_t CellularArray::state_raw(std::size_t k) const {
  return neuron(k).output.state_raw();
}
std::int32_t CellularArray::link_raw(std::size_t k) const {
  const auto per_cell = static_cast<std::size_t>(topology().neurons_per_cell);
  return cells_[k / per_cell]->out->wires()[k % per_cell];
}
void CellularArray::load(std::size_t k, std::int32_t raw) {
  neuron(k).load(raw);
}
void CellularArray::trace_cells(sc_core::sc_trace_file* file, const std::vector<std::size_t>& cells) const {
  for (std::size_t c : cells) cells_[c]->trace(file);
}

} // namespace hopmesh::systemc
