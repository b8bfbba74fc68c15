#include "rtl_model/systemc/datapath.h"

namespace hopmesh::systemc {

Datapath::Datapath(const spec::ArraySpec& array, std::size_t taps, std::size_t wires_of_a_source)
    : Points(spec::points_of(spec::built_formats(array, taps))), lanes(static_cast<std::size_t>(array.lanes)),
      per_source(wires_of_a_source), formats(spec::built_formats(array, taps)),
      exact(array.exact_accumulator), output(array.output), binary(array.output == spec::Output::binary),
      normaliser(array.normaliser), reciprocal_bits(array.reciprocal_bits),
      factor(output == spec::Output::projected ? array.relaxation : 1),
      factor_down(output == spec::Output::projected ? spec::relaxation_down : 0),
      quotient_up(ratio_up - factor_down),
      narrow(formats.accumulator.width + quotient_up + (factor > 1 ? 5 : 0) <= 62) {}

} // namespace hopmesh::systemc
