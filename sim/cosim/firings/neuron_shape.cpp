#include "sim/cosim/firings/neuron_shape.h"

#include "rtl_model/spec/points.h"

namespace hopmesh::cosim {

namespace {

int bits_of_norm(const spec::ArraySpec& array, const spec::Formats& formats, std::size_t taps) {
  const spec::Points points = spec::points_of(formats);
  const auto most_weight = std::uint64_t{1} << (formats.weight.width - 1);
  const auto most_bias = std::uint64_t{1} << (formats.bias.width - 1);
  const std::uint64_t weights = array.output == spec::Output::projected ? 1 : taps;
  const bool without_bias = array.output == spec::Output::projected || spec::has_momentum(array);
  const std::uint64_t most =
      ((weights * most_weight) << points.weight_up) + (without_bias ? 0 : most_bias << points.bias_up);
  int bits = 0;
  while (most >> bits != 0) ++bits;
  return bits;
}

} // namespace

NeuronShape::NeuronShape(const spec::ArraySpec& described, std::size_t most_taps)
    : array(described), taps(most_taps), beats(beats_of(most_taps)),
      formats(spec::built_formats(described, most_taps)),
      norm_bits(bits_of_norm(described, formats, most_taps)),
      drive_bits(formats.drive.width + (described.output == spec::Output::projected ? 1 : 0)),
      product_bits(formats.state.fraction_bits() + 3 +
                   (spec::has_momentum(described) ? spec::momentum_down : formats.drive.fraction_bits())) {}

} // namespace hopmesh::cosim
