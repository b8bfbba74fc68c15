#include "sim/engine/plan.h"

namespace hopmesh::engine {

Plan::Plan(const spec::ArraySpec& array, const spec::Topology& topology)
    : Points(spec::points_of(spec::built_formats(array, topology.most_taps()))),
      formats(spec::built_formats(array, topology.most_taps())), schedule(array.schedule),
      normaliser(array.normaliser), lanes(array.lanes), reciprocal_bits(array.reciprocal_bits),
      neurons_per_cell(topology.neurons_per_cell), exact(array.exact_accumulator),
      binary(array.output == spec::Output::binary), most_taps(topology.most_taps()),
      one_state(formats.state.one_raw()), one_drive(formats.drive.one_raw()),
      one_link(formats.link.one_raw()) {}

} // namespace hopmesh::engine
