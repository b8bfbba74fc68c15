// A two-part neuron: an input accumulator and an output stage, and the processes that wake them.
#pragma once

#include "rtl_model/systemc/input_accumulator.h"
#include "rtl_model/systemc/link.h"
#include "rtl_model/systemc/neuron_array.h"
#include "rtl_model/systemc/output_stage.h"

namespace hopmesh::systemc {

class Neuron : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(Neuron);
  /// Fires in phase `phase` and writes wire p of its cell's link register.
  Neuron(sc_core::sc_module_name name, const ArrayContext& context, std::size_t phase, std::size_t taps,
         LinkRegister& link, std::size_t p);

  InputAccumulator accumulator;
  OutputStage output;

  /// Loads V from the host; shows on the link at once.
  void load(std::int32_t raw);
  void trace(sc_core::sc_trace_file* file) const override;

 private:
  void on_prepare_done();
  void on_phase_done();
  void on_settled();
  void on_clock();
  void prepare_beat(std::uint64_t beat);
  void phase_beat(std::uint64_t beat);
  void normalise();
  void publish();

  Sequencer& sequencer_;
  ConvergenceDetector& detector_;
  const MomentumTable& momentum_;
  spec::Extremes& extremes_;
  LinkRegister& link_;
  const std::size_t p_;
  const int segment_;
  const std::uint64_t phase_cycles_, drive_cycles_, change_cycles_;
};

} // namespace hopmesh::systemc
