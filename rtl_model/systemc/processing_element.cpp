#include "rtl_model/systemc/processing_element.h"

#include "rtl_model/systemc/trace.h"

namespace hopmesh::systemc {

namespace {

std::vector<std::size_t> taps_of(const spec::Topology& t, const std::vector<std::uint32_t>& neurons) {
  std::vector<std::size_t> taps;
  for (std::uint32_t neuron : neurons) taps.push_back(t.taps(neuron / t.neurons_per_cell));
  return taps;
}

} // namespace

ElementRows element_rows(const spec::ArraySpec& array, const spec::Fold& fold, std::size_t element) {
  ElementRows rows;
  std::size_t fired = 0; // neurons of the phases before
  for (std::size_t k = 0; k < fold.order.size(); ++k) {
    rows.first.push_back(rows.neurons.size());
    for (const spec::Round& round : fold.rounds[k]) {
      if (element >= round.count) continue;
      const std::size_t position = round.first + element;
      rows.places.push_back(spec::shares_stage(array) ? fired + position : rows.neurons.size());
      rows.neurons.push_back(fold.order[k][position]);
    }
    fired += fold.order[k].size();
  }
  rows.first.push_back(rows.neurons.size());
  return rows;
}

ProcessingElement::ProcessingElement(sc_core::sc_module_name name, const FoldContext& context,
                                     const ElementRows& rows)
    : sc_module(name),
      accumulator(spec::accumulator_scope, context.array.path, taps_of(context.array.topology, rows.neurons)),
      context_(context), rows_(rows) {
  if (context.shared == nullptr)
    own_ = std::make_unique<PipelinedStage>(spec::stage_scope, context.array, context.links, rows.neurons);
  connect_links();
  wake_by_phase();
  const auto per_cell = static_cast<std::uint32_t>(context.array.topology.neurons_per_cell);
  for (std::size_t row = 0; row < rows.neurons.size(); ++row)
    accumulator.set_own_tap(rows.neurons[row] % per_cell, row);
}

void ProcessingElement::connect_links() {
  const spec::Topology& t = context_.array.topology;
  const auto per_cell = static_cast<std::size_t>(t.neurons_per_cell);
  for (std::size_t row = 0; row < rows_.neurons.size(); ++row) {
    const std::size_t cell = rows_.neurons[row] / per_cell;
    accumulator.connect(context_.links.wires(cell * per_cell), row);
    for (std::size_t k = t.first_link[cell]; k < t.first_link[cell + 1]; ++k)
      accumulator.connect(context_.links.wires(t.link_to[k] * per_cell), row);
  }
}

void ProcessingElement::wake_by_phase() {
  const Sequencer& sequencer = context_.array.sequencer;
  SC_METHOD(on_prepare_done);
  sensitive << sequencer.prepare_done();
  dont_initialize();
  SC_METHOD(on_phase_done);
  for (std::size_t k = 0; k + 1 < rows_.first.size(); ++k)
    if (rows_.first[k] < rows_.first[k + 1]) sensitive << sequencer.phase_done(k);
  dont_initialize();
}

void ProcessingElement::select(std::size_t row) {
  accumulator.select(row, context_.links.bank());
  worked_ = rows_.neurons[row];
}

void ProcessingElement::on_prepare_done() {
  for (std::size_t row = 0; row < rows_.neurons.size(); ++row) {
    select(row);
    accumulator.norm_row();
    stage().output.set_norm(accumulator.norm_raw(), rows_.places[row]);
  }
  if (!own_) held_ = accumulator.norm_raw();
}

// Woken once, in the phase's last cycle: all rounds of this element.
void ProcessingElement::on_phase_done() {
  const auto phase =
      static_cast<std::size_t>(context_.array.sequencer.running() - spec::Segment::first_phase);
  for (std::size_t row = rows_.first[phase]; row < rows_.first[phase + 1]; ++row) {
    select(row);
    accumulator.sum_row();
    if (own_)
      own_->fire(rows_.places[row], accumulator.sum_raw());
    else
      context_.shared->put_sum(rows_.places[row], held_ = accumulator.sum_raw());
  }
  if (own_) context_.links.end_phase();
}

void ProcessingElement::add_to_sum(std::size_t row, std::uint64_t beat) {
  if (beat == 0) {
    select(row);
    accumulator.begin_sum();
  }
  if (beat < accumulator.beats()) accumulator.sum_beat(beat);
}

void ProcessingElement::add_to_norm(std::size_t row, std::uint64_t beat) {
  if (beat == 0) {
    select(row);
    accumulator.begin_norm();
  }
  if (beat < accumulator.beats()) accumulator.norm_beat(beat);
}

void ProcessingElement::trace(sc_core::sc_trace_file* file) const {
  trace_register(file, worked_, *this, spec::worked_signal);
  accumulator.trace(file);
  if (own_)
    own_->trace(file);
  else
    trace_register(file, held_, *this, spec::held_signal);
}

} // namespace hopmesh::systemc
