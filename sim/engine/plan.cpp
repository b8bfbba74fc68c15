#include "sim/engine/plan.h"

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
  one_state = formats.state.one_raw();
  one_drive = formats.drive.one_raw();
  one_link = formats.link.one_raw();
}

} // namespace hopmesh::engine
