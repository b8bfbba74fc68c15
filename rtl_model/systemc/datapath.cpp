#include "rtl_model/systemc/datapath.h"

namespace hopmesh::systemc {

Datapath::Datapath(const spec::ArraySpec& array, std::size_t taps, std::size_t wires_of_a_source)
    : Points(spec::points_of(spec::built_formats(array, taps))), lanes(static_cast<std::size_t>(array.lanes)),
      per_source(wires_of_a_source), formats(spec::built_formats(array, taps)),
      exact(array.exact_accumulator), binary(array.output == spec::Output::binary),
      normaliser(array.normaliser), reciprocal_bits(array.reciprocal_bits),
      narrow(formats.accumulator.width + ratio_up <= 62) {}

} // namespace hopmesh::systemc
