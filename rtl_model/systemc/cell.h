// The hardware of one node: up to three neurons and their link register, wired to neighbours only.
#pragma once

#include "rtl_model/systemc/neuron.h"

#include <memory>

namespace hopmesh::systemc {

class Cell : public sc_core::sc_module {
 public:
  /// `phases`: for each neuron of the cell, the phase in which it fires.
  Cell(sc_core::sc_module_name name, const ArrayContext& context, std::size_t index,
       const std::vector<std::size_t>& phases);

  sc_core::sc_export<LinkIf> out;                  ///< this cell's outputs
  sc_core::sc_vector<sc_core::sc_port<LinkIf>> in; ///< one a neighbour, in link order

  Neuron& neuron(std::size_t p) const { return *neurons_[p]; }
  void trace(sc_core::sc_trace_file* file) const override;

 private:
  void end_of_elaboration() override;

  LinkRegister link_;
  std::vector<std::unique_ptr<Neuron>> neurons_;
};

} // namespace hopmesh::systemc
