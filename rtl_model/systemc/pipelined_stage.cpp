#include "rtl_model/systemc/pipelined_stage.h"

#include "rtl_model/systemc/trace.h"

namespace hopmesh::systemc {

PipelinedStage::PipelinedStage(sc_core::sc_module_name name, const ArrayContext& context, LinkMemory& links,
                               const std::vector<std::uint32_t>& neurons)
    : sc_module(name), output(spec::output_scope, context.path, neurons.size()), context_(context),
      links_(links), neurons_(neurons), drive_cycles_(spec::drive_cycles(context.array)),
      change_cycles_(spec::change_cycles(context.array)), stage_cycles_(spec::stage_cycles(context.array)),
      norm_cycles_(std::max<std::uint64_t>(1, spec::reciprocal_cycles(context.array))),
      sums_(neurons.size()) {
  SC_METHOD(fire_all);
  sensitive << all_put_;
  dont_initialize();
  if (!context.momentum.exists()) return;
  SC_METHOD(settle_all);
  sensitive << context.sequencer.settled();
  dont_initialize();
}

// In the bank that is read: nobody reads it while this happens.
void PipelinedStage::settle_all() {
  for (std::size_t place = 0; place < neurons_.size(); ++place) {
    output.settle(place);
    links_.load(neurons_[place], output.link_raw(place));
  }
}

// The oldest first: it leaves a register before the next one writes it.
void PipelinedStage::clock() {
  bool out = false;
  for (Passenger& passenger : inside_) out |= pass(passenger);
  if (out) inside_.pop_front();
}

void PipelinedStage::enter(Passenger passenger) {
  if (!pass(passenger)) inside_.push_back(passenger);
}

bool PipelinedStage::pass(Passenger& passenger) {
  passenger.passed += 1;
  if (passenger.is_norm) {
    if (passenger.passed < norm_cycles_) return false;
    output.set_norm(passenger.value, passenger.place);
    return true;
  }
  if (passenger.passed == drive_cycles_) {
    normalise(passenger.place, passenger.value);
    passenger.drive = output.drive_raw();
  }
  if (passenger.passed == change_cycles_) output.find_change(passenger.drive, passenger.place);
  if (passenger.passed < stage_cycles_) return false;
  publish(passenger.place, passenger.value);
  return true;
}

void PipelinedStage::fire(std::size_t place, std::int64_t sum_raw) {
  normalise(place, sum_raw);
  output.find_change(output.drive_raw(), place);
  publish(place, sum_raw);
}

void PipelinedStage::put_sum(std::size_t place, std::int64_t sum_raw) {
  sums_[place] = sum_raw;
  first_put_ = std::min(first_put_, place);
  last_put_ = std::max(last_put_, place);
  all_put_.notify(sc_core::SC_ZERO_TIME);
}

void PipelinedStage::fire_all() {
  for (std::size_t place = first_put_; place <= last_put_; ++place) fire(place, sums_[place]);
  first_put_ = SIZE_MAX;
  last_put_ = 0;
  links_.end_phase();
}

void PipelinedStage::normalise(std::size_t place, std::int64_t sum_raw) {
  output.normalise(sum_raw, place);
  context_.extremes.note(sum_raw, output.drive_raw());
  shown_ = neurons_[place];
}

void PipelinedStage::publish(std::size_t place, std::int64_t sum_raw) {
  const bool held = context_.detector.compares_sums() && output.is_held(sum_raw, place);
  context_.detector.report(sum_raw, output.publish(place, context_.momentum.now()), held);
  links_.write(neurons_[place], output.link_raw(place));
}

void PipelinedStage::trace(sc_core::sc_trace_file* file) const {
  trace_register(file, shown_, *this, spec::worked_signal);
  output.trace(file);
}

} // namespace hopmesh::systemc
