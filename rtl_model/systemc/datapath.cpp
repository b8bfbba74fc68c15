#include "rtl_model/systemc/datapath.h"

namespace hopmesh::systemc {

namespace {

int product_fraction(const spec::Formats& f) {
  return f.weight.fraction_bits() + f.link.fraction_bits();
}

int sum_fraction(const spec::Formats& f) {
  return std::max(product_fraction(f), f.bias.fraction_bits());
}

int norm_fraction(const spec::Formats& f) {
  return std::max(f.weight.fraction_bits(), f.bias.fraction_bits());
}

} // namespace

Datapath::Datapath(const spec::ArraySpec& array, const spec::NumberFormat& accumulator_format,
                   std::size_t wires_of_a_source)
    : lanes(static_cast<std::size_t>(array.lanes)), per_source(wires_of_a_source),
      accumulator(accumulator_format), drive(array.formats.drive), state(array.formats.state),
      link(array.formats.link), exact(array.exact_accumulator), binary(array.output == spec::Output::binary),
      normaliser(array.normaliser), reciprocal_bits(array.reciprocal_bits),
      product_up(sum_fraction(array.formats) - product_fraction(array.formats)),
      sum_up(sum_fraction(array.formats) - accumulator.fraction_bits()),
      bias_places(array.formats.bias.fraction_bits() - accumulator.fraction_bits()),
      weight_norm_up(norm_fraction(array.formats) - array.formats.weight.fraction_bits()),
      bias_norm_up(norm_fraction(array.formats) - array.formats.bias.fraction_bits()),
      ratio_up(drive.fraction_bits() + norm_fraction(array.formats) - accumulator.fraction_bits()),
      scaled_places(accumulator.fraction_bits() - drive.fraction_bits()),
      narrow(accumulator.width + ratio_up <= 62) {}

} // namespace hopmesh::systemc
