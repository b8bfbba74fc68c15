// A run made from formulas, equal at every call: a 20 x 20 flag that waves, with the series a study would
// fill.
#pragma once

#include "sim/pictures/run_view.h"

namespace hopmesh::tests {

pictures::RunView sample_run(std::size_t side = 20, std::size_t frames = 240, std::size_t steps = 400);

} // namespace hopmesh::tests
