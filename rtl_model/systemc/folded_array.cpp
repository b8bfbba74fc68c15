#include "rtl_model/systemc/folded_array.h"

#include "rtl_model/spec/signals.h"

namespace hopmesh::systemc {

using spec::Segment;

FoldedArray::FoldedArray(sc_core::sc_module_name name, const spec::ArraySpec& array,
                         const spec::Topology& topology)
    : NeuronArray(name, array, topology), fold_(spec::fold_of(this->array(), this->topology(), phases())),
      links_("links", topology.neurons(), array.schedule == spec::Schedule::synchronous) {
  make_elements();
  SC_METHOD(on_clock);
  sensitive << sequencer.clock().posedge_event();
  dont_initialize();
}

void FoldedArray::make_elements() {
  if (spec::shares_stage(array())) {
    std::vector<std::uint32_t> all;
    for (const auto& phase : fold_.order) all.insert(all.end(), phase.begin(), phase.end());
    shared_ = std::make_unique<PipelinedStage>(spec::stage_scope, context_, links_, all);
  }
  fold_context_ = std::make_unique<FoldContext>(FoldContext{context_, links_, shared_.get()});
  homes_.resize(topology().neurons());
  for (std::size_t e = 0; e < static_cast<std::size_t>(array().elements); ++e) {
    const ElementRows rows = element_rows(array(), fold_, e);
    if (rows.neurons.empty()) break;
    const std::string element = spec::element_scope(e);
    elements_.push_back(std::make_unique<ProcessingElement>(element.c_str(), *fold_context_, rows));
    for (std::size_t row = 0; row < rows.neurons.size(); ++row)
      homes_[rows.neurons[row]] = {elements_.back().get(), row};
  }
}

// ---- the host ----

std::int32_t FoldedArray::weight(std::size_t neuron, std::size_t tap) const {
  return homes_[neuron].element->accumulator.weight(tap, homes_[neuron].row);
}
void FoldedArray::set_weight(std::size_t neuron, std::size_t tap, std::int32_t raw) {
  homes_[neuron].element->accumulator.set_weight(tap, raw, homes_[neuron].row);
}
std::int32_t FoldedArray::bias(std::size_t neuron) const {
  return homes_[neuron].element->accumulator.bias(homes_[neuron].row);
}
void FoldedArray::set_bias(std::size_t neuron, std::int32_t raw) {
  homes_[neuron].element->accumulator.set_bias(raw, homes_[neuron].row);
}
std::int64_t FoldedArray::state_raw(std::size_t neuron) const {
  return homes_[neuron].stage().output.state_raw(homes_[neuron].place());
}
std::int64_t FoldedArray::reciprocal_raw(std::size_t neuron) const {
  return homes_[neuron].stage().output.reciprocal_raw(homes_[neuron].place());
}

void FoldedArray::load(std::size_t neuron, std::int32_t raw) {
  OutputStage& output = homes_[neuron].stage().output;
  output.load(raw, homes_[neuron].place());
  links_.load(neuron, output.link_raw(homes_[neuron].place()));
}

void FoldedArray::trace_cells(sc_core::sc_trace_file* file, const std::vector<std::size_t>& cells) const {
  for (const auto& element : elements_) element->trace(file);
  if (shared_) shared_->trace(file);
  const auto per_cell = static_cast<std::size_t>(topology().neurons_per_cell);
  for (std::size_t c : cells)
    for (std::size_t p = 0; p < per_cell; ++p) {
      const Home& home = homes_[c * per_cell + p];
      home.stage().output.trace_state(
          file, std::string(name()) + "." + spec::cell_scope(c) + "." + spec::neuron_scope(p), home.place());
    }
}

// ---- by clock ----

void FoldedArray::on_clock() {
  const int segment = sequencer.segment();
  if (segment == Segment::prepare) return clock(fold_.prepare, true);
  if (segment < Segment::first_phase) return;
  const auto phase = static_cast<std::size_t>(segment - Segment::first_phase);
  clock(fold_.rounds[phase], false);
  if (sequencer.beat() + 1 == cycles().phase[phase]) links_.end_phase();
}

// Stages come first: they take what accumulators and hold registers had before this edge.
void FoldedArray::clock(const spec::Rounds& rounds, bool norms) {
  if (sequencer.beat() == 0) { // the memories are read
    round_ = waiting_ = 0;
    beat_ = 0;
    return;
  }
  feed_stages(rounds, norms);
  if (round_ == rounds.size()) return;
  if (beat_ < rounds[round_].accumulate) add(rounds[round_], norms);
  hand_on(rounds[round_], norms);
}

void FoldedArray::feed_stages(const spec::Rounds& rounds, bool norms) {
  const auto take = [norms](const ProcessingElement& element, std::size_t row, std::int64_t raw) {
    if (norms)
      element.stage().take_norm(element.place(row), raw);
    else
      element.stage().take_sum(element.place(row), raw);
  };
  if (shared_) {
    shared_->clock();
    if (waiting_ == 0) return;
    const spec::Round& round = rounds[round_ - 1];
    const ProcessingElement& next = *elements_[round.count - waiting_--];
    return take(next, row_of(next, round), next.held());
  }
  for (const auto& element : elements_) element->stage().clock();
  for (std::size_t e = 0; e < waiting_; ++e) {
    const ProcessingElement& element = *elements_[e];
    const InputAccumulator& sums = element.accumulator;
    take(element, row_of(element, rounds[round_ - 1]), norms ? sums.norm_raw() : sums.sum_raw());
  }
  waiting_ = 0;
}

void FoldedArray::add(const spec::Round& round, bool norms) {
  for (std::size_t e = 0; e < round.count; ++e) {
    ProcessingElement& element = *elements_[e];
    if (norms)
      element.add_to_norm(row_of(element, round), beat_);
    else
      element.add_to_sum(row_of(element, round), beat_);
  }
  beat_ += 1;
}

// A norm that nobody inverts goes into its element's memory at once.
void FoldedArray::hand_on(const spec::Round& round, bool norms) {
  if (beat_ < round.accumulate || !stages_free()) return;
  const bool at_once = norms && !shared_ && spec::reciprocal_cycles(array()) == 0;
  for (std::size_t e = 0; e < round.count; ++e) {
    ProcessingElement& element = *elements_[e];
    const InputAccumulator& sums = element.accumulator;
    if (shared_) element.hold(norms ? sums.norm_raw() : sums.sum_raw());
    if (at_once) element.stage().output.set_norm(sums.norm_raw(), element.place(row_of(element, round)));
  }
  waiting_ = at_once ? 0 : round.count;
  round_ += 1;
  beat_ = 0;
}

// Element 0 has a neuron in every round.
bool FoldedArray::stages_free() const {
  return waiting_ == 0 && (shared_ || elements_[0]->stage().empty());
}

std::size_t FoldedArray::row_of(const ProcessingElement& element, const spec::Round& round) const {
  return element.row(round.phase, round.first / static_cast<std::size_t>(array().elements));
}

} // namespace hopmesh::systemc
