#include "sim/engine/neuron_plan.h"

#include "sim/engine/division.h"

namespace hopmesh::engine {

namespace {

int bits_of_norm(const NeuronPlan& plan) {
  const auto most_weight = std::uint64_t{1} << (plan.formats.weight.width - 1);
  const auto most_bias = std::uint64_t{1} << (plan.formats.bias.width - 1);
  return bit_length(((plan.most_taps * most_weight) << plan.weight_up) + (most_bias << plan.bias_up));
}

} // namespace

NeuronPlan::NeuronPlan(const spec::ArraySpec& array, const spec::Topology& topology)
    : NeuronPlan(array, topology.most_taps(), topology.neurons_per_cell) {}

NeuronPlan::NeuronPlan(const spec::ArraySpec& array, std::size_t taps, int neurons_in_cell)
    : Points(spec::points_of(spec::built_formats(array, taps))), formats(spec::built_formats(array, taps)),
      schedule(array.schedule), normaliser(array.normaliser), lanes(array.lanes),
      reciprocal_bits(array.reciprocal_bits), neurons_per_cell(neurons_in_cell),
      exact(array.exact_accumulator), binary(array.output == spec::Output::binary), most_taps(taps),
      norm_bits(bits_of_norm(*this)), multiplier_places(norm_bits + reciprocal_bits - 2 - ratio_up),
      one_state(formats.state.one_raw()), one_drive(formats.drive.one_raw()),
      one_link(formats.link.one_raw()) {}

} // namespace hopmesh::engine
