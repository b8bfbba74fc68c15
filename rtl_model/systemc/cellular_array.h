// The array: cells and links as the topology says, the sequencer and the convergence detector. Wires only.
#pragma once

#include "rtl_model/systemc/cell.h"

namespace hopmesh::systemc {

class CellularArray : public sc_core::sc_module {
 public:
  CellularArray(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology);
  ~CellularArray() override;

  const spec::ArraySpec& array() const { return array_; }
  const spec::Topology& topology() const { return topology_; }
  const spec::Phases& phases() const { return phases_; }
  const spec::CycleModel& cycles() const { return cycles_; }
  sc_core::sc_time period() const { return period_; }

  Neuron& neuron(std::size_t index) const {
    return cells_[index / topology_.neurons_per_cell]->neuron(index % topology_.neurons_per_cell);
  }
  Cell& cell(std::size_t index) const { return *cells_[index]; }

 private:
  const spec::ArraySpec array_;
  const spec::Topology topology_;
  const spec::Phases phases_;
  const spec::CycleModel cycles_;
  const sc_core::sc_time period_;

 public:
  ConvergenceDetector detector;
  spec::Extremes extremes;
  Sequencer sequencer;

 private:
  const ArrayContext context_;
  std::vector<std::unique_ptr<Cell>> cells_;

  void wire_links();
};

} // namespace hopmesh::systemc
