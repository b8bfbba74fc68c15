#include "rtl_model/systemc/input_accumulator.h"

#include "rtl_model/systemc/rounding.h"
#include "rtl_model/systemc/trace.h"

#include <cstdlib>

namespace hopmesh::systemc {

InputAccumulator::InputAccumulator(sc_core::sc_module_name name, const Datapath& path,
                                   const std::vector<std::size_t>& taps)
    : sc_module(name), path_(path), rows_(taps.size()) {
  for (std::size_t k = 0; k < taps.size(); ++k) {
    rows_[k].weights.assign(taps[k], 0);
    rows_[k].sources.resize(taps[k] / path.per_source);
  }
  select(0);
}

void InputAccumulator::begin_sum() {
  const auto& q = path_.formats.accumulator;
  sum_ = path_.exact ? at_.bias * (std::int64_t{1} << -path_.bias_down)
                     : into_range<Wide>(round_places<Wide>(at_.bias, path_.bias_down, q.rounding), q);
}

void InputAccumulator::sum_beat(std::size_t k) {
  add(dot(k * path_.lanes, std::min(taps(), (k + 1) * path_.lanes)));
}

void InputAccumulator::sum_row() {
  begin_sum();
  if (path_.exact) return add(dot_row());
  for (std::size_t k = 0; k < beats(); ++k) sum_beat(k);
}

void InputAccumulator::begin_norm() {
  norm_ = path_.output == spec::Output::modified ? std::abs(std::int64_t{at_.bias}) << path_.bias_up : 0;
}

void InputAccumulator::norm_beat(std::size_t k) {
  const bool own_only = path_.output == spec::Output::projected;
  for (std::size_t t = k * path_.lanes; t < std::min(taps(), (k + 1) * path_.lanes); ++t)
    if (!own_only || t == at_.own) norm_ += std::abs(std::int64_t{at_.weights[t]}) << path_.weight_up;
}

void InputAccumulator::norm_row() {
  begin_norm();
  for (std::size_t k = 0; k < beats(); ++k) norm_beat(k);
}

std::int64_t InputAccumulator::dot(std::size_t first, std::size_t last) const {
  std::int64_t products = 0;
  for (std::size_t t = first; t < last; ++t)
    products += std::int64_t{at_.weights[t]} *
                at_.sources[t / path_.per_source][bank_ + static_cast<std::ptrdiff_t>(t % path_.per_source)];
  return products;
}

std::int64_t InputAccumulator::dot_row() const {
  std::int64_t products = 0;
  const std::int32_t* weight = at_.weights;
  for (const std::int32_t* const* wires = at_.sources; wires != at_.sources_end; ++wires) {
    const std::int32_t* source = *wires + bank_;
    for (std::size_t q = 0; q < path_.per_source; ++q) products += std::int64_t{*weight++} * source[q];
  }
  return products;
}

// An exact accumulator has room for every place; any other is rounded each time its register is written.
void InputAccumulator::add(std::int64_t products) {
  if (path_.exact) {
    sum_ += products * (std::int64_t{1} << path_.product_up);
    return;
  }
  const Wide exact = Wide{sum_} * (Wide{1} << path_.sum_up) + Wide{products} * (Wide{1} << path_.product_up);
  sum_ = into_range(round_places(exact, path_.sum_up, path_.formats.accumulator.rounding),
                    path_.formats.accumulator);
}

void InputAccumulator::trace(sc_core::sc_trace_file* file) const {
  const spec::NeuronSignals signals = spec::neuron_signals(path_.formats);
  trace_register(file, sum_, *this, signals.sum);
  trace_register(file, norm_, *this, signals.norm);
}

} // namespace hopmesh::systemc
