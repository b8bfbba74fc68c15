// A neuron laid open: accumulator and output stage driven by hand, beat by beat, without clock and links.
#pragma once

#include "rtl_model/spec/firing.h"
#include "rtl_model/systemc/input_accumulator.h"
#include "rtl_model/systemc/output_stage.h"

namespace hopmesh::systemc {

/// To be made before simulation starts, as every module.
class OpenNeuron {
 public:
  /// Of an array that has passed spec::validate for rows of at most `taps` inputs.
  OpenNeuron(const spec::ArraySpec& array, std::size_t taps);
  OpenNeuron(const OpenNeuron&) = delete;
  OpenNeuron& operator=(const OpenNeuron&) = delete;

  /// Codes must lie within their formats. A row may be shorter than the longest.
  spec::FiringSteps fire(const spec::FiringInputs& inputs);

 private:
  void load(const spec::FiringInputs& inputs);

  const Datapath path_;
  const bool sums_norm_;
  std::vector<std::int32_t> wires_; ///< L of the sources
  InputAccumulator accumulator_;
  OutputStage output_;
};

} // namespace hopmesh::systemc
