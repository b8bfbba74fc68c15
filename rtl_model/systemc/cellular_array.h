// The array of the paper: a cell for each node, with neurons of its own, and links as the topology says.
// Wires only.
#pragma once

#include "rtl_model/systemc/cell.h"

namespace hopmesh::systemc {

class CellularArray : public NeuronArray {
 public:
  CellularArray(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology);
  ~CellularArray() override;

  Neuron& neuron(std::size_t index) const {
    const auto per_cell = static_cast<std::size_t>(topology().neurons_per_cell);
    return cells_[index / per_cell]->neuron(index % per_cell);
  }

  std::int32_t weight(std::size_t neuron, std::size_t tap) const override;
  void set_weight(std::size_t neuron, std::size_t tap, std::int32_t raw) override;
  std::int32_t bias(std::size_t neuron) const override;
  void set_bias(std::size_t neuron, std::int32_t raw) override;
  std::int64_t state_raw(std::size_t neuron) const override;
  std::int32_t link_raw(std::size_t neuron) const override;
  void load(std::size_t neuron, std::int32_t raw) override;
  void trace_cells(sc_core::sc_trace_file* file, const std::vector<std::size_t>& cells) const override;

 private:
  std::vector<std::unique_ptr<Cell>> cells_;

  void wire_links();
};

} // namespace hopmesh::systemc
