// What a device has of its array, whichever way neurons are built: the description, the sequencer, the
// convergence detector, and the memories of all neurons.
#pragma once

#include "rtl_model/spec/relaxation.h"
#include "rtl_model/systemc/datapath.h"
#include "rtl_model/systemc/sequencer.h"

#include <memory>

namespace hopmesh::systemc {

/// What every neuron of an array shares.
struct ArrayContext {
  const spec::ArraySpec& array;
  const spec::Topology& topology;
  const Datapath path;
  Sequencer& sequencer;
  ConvergenceDetector& detector;
  MomentumTable& momentum;
  spec::Extremes& extremes;
};

/// Neurons are numbered as in spec::Topology; codes are raw.
class NeuronArray : public sc_core::sc_module {
 public:
  NeuronArray(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology);

  const spec::ArraySpec& array() const { return array_; }
  const spec::Topology& topology() const { return topology_; }
  const spec::Phases& phases() const { return phases_; }
  const spec::CycleModel& cycles() const { return cycles_; }
  sc_core::sc_time period() const { return period_; }

  virtual std::int32_t weight(std::size_t neuron, std::size_t tap) const = 0;
  virtual void set_weight(std::size_t neuron, std::size_t tap, std::int32_t raw) = 0;
  virtual std::int32_t bias(std::size_t neuron) const = 0;
  virtual void set_bias(std::size_t neuron, std::int32_t raw) = 0;
  virtual std::int64_t state_raw(std::size_t neuron) const = 0;
  virtual std::int32_t link_raw(std::size_t neuron) const = 0; ///< V, or Y, as neighbours see it
  /// Loads V from the host; shows on the link at once.
  virtual void load(std::size_t neuron, std::int32_t raw) = 0;
  /// Registers of the array, and what these cells hold.
  virtual void trace_cells(sc_core::sc_trace_file* file, const std::vector<std::size_t>& cells) const = 0;

 private:
  const spec::ArraySpec array_;
  const spec::Topology topology_;
  const spec::Phases phases_;
  const spec::CycleModel cycles_;
  const sc_core::sc_time period_;

 public:
  ConvergenceDetector detector;
  MomentumTable momentum;
  spec::Extremes extremes;
  Sequencer sequencer;

 protected:
  const ArrayContext context_;
};

/// Each neuron in a place of its own, or folded, as the description wants it. `name`: of the module.
std::unique_ptr<NeuronArray> make_array(const char* name, const spec::ArraySpec& array,
                                        const spec::Topology& topology);

} // namespace hopmesh::systemc
