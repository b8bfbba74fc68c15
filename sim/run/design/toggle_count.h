// Which share of the bits at an element's multiplier changes from one tap to the next, counted on a motion:
// what the host loads, and where outputs came to rest.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/machine/cost/energy.h"

namespace hopmesh::run {

/// After so many steps of the motion (at least one). Rows are taken one behind the other, as a single element
/// would; of links the places that the state has more are cut off.
machine::Toggles count_toggles(const levels::Prepared& prepared, std::size_t steps);

} // namespace hopmesh::run
