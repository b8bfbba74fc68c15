#include "sim/engine/plan.h"

#include "sim/engine/division.h"

namespace hopmesh::engine {

Plan::Plan(const spec::ArraySpec& array, const spec::Topology& topology)
    : formats(array.formats), schedule(array.schedule), normaliser(array.normaliser), lanes(array.lanes),
      reciprocal_bits(array.reciprocal_bits), neurons_per_cell(topology.neurons_per_cell),
      exact(array.exact_accumulator), binary(array.output == spec::Output::binary),
      most_taps(topology.most_taps()) {
  formats.accumulator = spec::accumulator_format(array, most_taps);
  const int weight = formats.weight.fraction_bits(), bias = formats.bias.fraction_bits();
  const int product = weight + formats.link.fraction_bits(), finest = std::max(product, bias);
  const int sum = formats.accumulator.fraction_bits(), row = std::max(weight, bias);
  const int drive = formats.drive.fraction_bits(), state = formats.state.fraction_bits();
  product_up = finest - product;
  sum_up = finest - sum;
  bias_down = bias - sum;
  weight_up = row - weight;
  bias_up = row - bias;
  ratio_up = drive + row - sum;
  scaled_down = sum - drive;
  link_down = state - formats.link.fraction_bits();
  const auto most_weight = std::uint64_t{1} << (formats.weight.width - 1);
  const auto most_bias = std::uint64_t{1} << (formats.bias.width - 1);
  norm_bits = bit_length(((most_taps * most_weight) << weight_up) + (most_bias << bias_up));
  multiplier_places = norm_bits + reciprocal_bits - 2 - ratio_up;
  one_state = formats.state.one_raw();
  one_drive = formats.drive.one_raw();
  one_link = formats.link.one_raw();
}

} // namespace hopmesh::engine
