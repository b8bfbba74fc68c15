// An element of a folded array: an accumulator, the rows of the neurons that it works on round by round, and
// either an output stage or a hold register in front of the shared one.
#pragma once

#include "rtl_model/spec/rounds.h"
#include "rtl_model/systemc/input_accumulator.h"
#include "rtl_model/systemc/pipelined_stage.h"

namespace hopmesh::systemc {

/// What the elements of an array share. `shared`: the stage, where there is one for all.
struct FoldContext {
  const ArrayContext& array;
  LinkMemory& links;
  PipelinedStage* shared;
};

/// Rows of an element, one for each round of each phase in which it has a neuron.
struct ElementRows {
  std::vector<std::size_t> first;     ///< of each phase, and behind the last one
  std::vector<std::uint32_t> neurons; ///< of each row
  std::vector<std::size_t> places;    ///< of each row, in the stage
};
ElementRows element_rows(const spec::ArraySpec& array, const spec::Fold& fold, std::size_t element);

class ProcessingElement : public sc_core::sc_module {
 public:
  SC_HAS_PROCESS(ProcessingElement);
  ProcessingElement(sc_core::sc_module_name name, const FoldContext& context, const ElementRows& rows);

  InputAccumulator accumulator;

  std::size_t row(std::size_t phase, std::size_t round) const { return rows_.first[phase] + round; }
  /// The stage of this element's neurons.
  PipelinedStage& stage() const { return own_ ? *own_ : *context_.shared; }
  std::size_t place(std::size_t row) const { return rows_.places[row]; }

  // By clock. A cycle adds a group of taps to s or N; the first starts the row.
  void add_to_sum(std::size_t row, std::uint64_t beat);
  void add_to_norm(std::size_t row, std::uint64_t beat);
  void hold(std::int64_t raw) { held_ = raw; }
  std::int64_t held() const { return held_; }

  void trace(sc_core::sc_trace_file* file) const override;

 private:
  void connect_links();
  void wake_by_phase();
  void on_prepare_done();
  void on_phase_done();
  void select(std::size_t row);

  const FoldContext context_;
  const ElementRows rows_;
  std::unique_ptr<PipelinedStage> own_;
  std::int64_t held_ = 0;
  std::uint32_t worked_ = 0; ///< the neuron of the selected row
};

} // namespace hopmesh::systemc
