// A neuron laid open: every number between its inputs and its outputs, by the arithmetic that the generic
// core turns to where a format asks for 128 bits.
#pragma once

#include "rtl_model/spec/firing.h"
#include "sim/engine/generic/drive_path.h"
#include "sim/engine/generic/wide_sum.h"

namespace hopmesh::engine {

class OpenNeuron {
 public:
  /// Of an array that has passed spec::validate for rows of at most `taps` inputs.
  OpenNeuron(const spec::ArraySpec& array, std::size_t taps);
  OpenNeuron(const OpenNeuron&) = delete;
  OpenNeuron& operator=(const OpenNeuron&) = delete;

  /// Codes must lie within their formats.
  spec::FiringSteps fire(const spec::FiringInputs& inputs) const;

 private:
  std::vector<std::int64_t> sums(const spec::FiringInputs& inputs) const;
  std::uint64_t norm(const spec::FiringInputs& inputs) const;
  // From u to what neighbours see: a pull to the bound that u points to, or a step.
  void pull(const spec::FiringInputs& inputs, spec::FiringSteps& steps) const;
  void step(const spec::FiringInputs& inputs, spec::FiringSteps& steps) const;

  const NeuronPlan plan_;
  const bool sums_norm_;
  const DrivePath path_;
  const WideSum sum_;
  const ShiftRounding to_state_, to_link_, gained_;
  const StepRounding step_;
};

} // namespace hopmesh::engine
