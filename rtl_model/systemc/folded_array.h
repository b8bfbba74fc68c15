// An array whose neurons share elements: the elements, their links, the shared stage, and the counters that
// lead all of them through rounds.
#pragma once

#include "rtl_model/systemc/processing_element.h"

namespace hopmesh::systemc {

/// By clock, rounds follow each other as stages and hold registers become free; nothing here looks at the
/// formulas of cycles.
class FoldedArray : public NeuronArray {
 public:
  SC_HAS_PROCESS(FoldedArray);
  FoldedArray(sc_core::sc_module_name name, const spec::ArraySpec& array, const spec::Topology& topology);

  /// Elements that have work; further ones would idle, and are left out.
  const std::vector<std::unique_ptr<ProcessingElement>>& elements() const { return elements_; }
  const PipelinedStage* shared_stage() const { return shared_.get(); }

  std::int32_t weight(std::size_t neuron, std::size_t tap) const override;
  void set_weight(std::size_t neuron, std::size_t tap, std::int32_t raw) override;
  std::int32_t bias(std::size_t neuron) const override;
  void set_bias(std::size_t neuron, std::int32_t raw) override;
  std::int64_t state_raw(std::size_t neuron) const override;
  std::int64_t reciprocal_raw(std::size_t neuron) const; ///< of the last N that was not zero
  std::int32_t link_raw(std::size_t neuron) const override { return links_.read(neuron); }
  void load(std::size_t neuron, std::int32_t raw) override;
  void trace_cells(sc_core::sc_trace_file* file, const std::vector<std::size_t>& cells) const override;

 private:
  /// Where a neuron is worked on.
  struct Home {
    ProcessingElement* element;
    std::size_t row;
    PipelinedStage& stage() const { return element->stage(); }
    std::size_t place() const { return element->place(row); }
  };

  void make_elements();
  void on_clock();
  void clock(const spec::Rounds& rounds, bool norms);
  void feed_stages(const spec::Rounds& rounds, bool norms);
  void add(const spec::Round& round, bool norms);
  void hand_on(const spec::Round& round, bool norms);
  bool stages_free() const;
  std::size_t row_of(const ProcessingElement& element, const spec::Round& round) const;

  const spec::Fold fold_;
  LinkMemory links_;
  std::unique_ptr<PipelinedStage> shared_;
  std::unique_ptr<const FoldContext> fold_context_;
  std::vector<std::unique_ptr<ProcessingElement>> elements_;
  std::vector<Home> homes_; ///< of each neuron
  // Counters, by clock.
  std::size_t round_ = 0;   ///< that accumulates
  std::uint64_t beat_ = 0;  ///< cycles that it has accumulated
  std::size_t waiting_ = 0; ///< sums of the round before that are on their way into a stage
};

} // namespace hopmesh::systemc
