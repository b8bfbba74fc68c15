#include "rtl_model/systemc/neuron.h"

#include "rtl_model/spec/signals.h"

namespace hopmesh::systemc {

Neuron::Neuron(sc_core::sc_module_name name, const ArrayContext& context, std::size_t phase, std::size_t taps,
               LinkRegister& link, std::size_t p)
    : sc_module(name), accumulator(spec::accumulator_scope, context.path, {taps}),
      output(spec::output_scope, context.path), sequencer_(context.sequencer), detector_(context.detector),
      momentum_(context.momentum), extremes_(context.extremes), link_(link), p_(p),
      segment_(spec::Segment::first_phase + static_cast<int>(phase)),
      phase_cycles_(context.sequencer.phase_cycles(phase)), drive_cycles_(spec::drive_cycles(context.array)),
      change_cycles_(spec::change_cycles(context.array)) {
  SC_METHOD(on_prepare_done);
  sensitive << sequencer_.prepare_done();
  dont_initialize();
  SC_METHOD(on_phase_done);
  sensitive << sequencer_.phase_done(phase);
  dont_initialize();
  SC_METHOD(on_clock);
  sensitive << sequencer_.clock().posedge_event();
  dont_initialize();
  accumulator.set_own_tap(p);
  if (!momentum_.exists()) return;
  SC_METHOD(on_settled);
  sensitive << sequencer_.settled();
  dont_initialize();
}

void Neuron::load(std::int32_t raw) {
  output.load(raw);
  link_.load(p_, output.link_raw());
}

void Neuron::on_prepare_done() {
  accumulator.norm_row();
  output.set_norm(accumulator.norm_raw());
}

// Woken once, in the phase's last cycle: the whole row, then the output stage.
void Neuron::on_phase_done() {
  accumulator.sum_row();
  normalise();
  output.find_change(output.drive_raw());
  publish();
}

// Nobody reads links while this happens: a check, or the start of a run.
void Neuron::on_settled() {
  output.settle();
  link_.load(p_, output.link_raw());
}

void Neuron::normalise() {
  output.normalise(accumulator.sum_raw());
  extremes_.note(accumulator.sum_raw(), output.drive_raw());
}

void Neuron::publish() {
  const std::int64_t sum = accumulator.sum_raw();
  const bool held = detector_.compares_sums() && output.is_held(sum);
  detector_.report(sum, output.publish(0, momentum_.now()), held);
  link_.write(p_, output.link_raw());
}

// Woken at every edge: mostly to find that another colour's phase is on.
void Neuron::on_clock() {
  const int segment = sequencer_.segment();
  if (segment == segment_) return phase_beat(sequencer_.beat());
  if (segment == spec::Segment::prepare) prepare_beat(sequencer_.beat());
}

void Neuron::prepare_beat(std::uint64_t beat) {
  if (beat == 0) accumulator.begin_norm();
  if (beat < accumulator.beats()) accumulator.norm_beat(beat);
  if (beat + 1 == sequencer_.prepare_cycles()) output.set_norm(accumulator.norm_raw());
}

// Accumulate, normalise, R u, publish; a row shorter than the phase's longest waits before it publishes.
void Neuron::phase_beat(std::uint64_t beat) {
  const std::uint64_t beats = accumulator.beats();
  if (beat == 0) accumulator.begin_sum();
  if (beat < beats) accumulator.sum_beat(beat);
  if (beat + 1 == beats + drive_cycles_) normalise();
  if (beat + 1 == beats + change_cycles_) output.find_change(output.drive_raw());
  if (beat + 1 == phase_cycles_) publish();
}

void Neuron::trace(sc_core::sc_trace_file* file) const {
  accumulator.trace(file);
  output.trace(file);
  output.trace_state(file, output.name());
}

} // namespace hopmesh::systemc
