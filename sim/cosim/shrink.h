// From a job on which two levels differ to the smallest one nearby on which they still do.
#pragma once

#include "sim/cosim/array_job.h"

#include <functional>

namespace hopmesh::cosim {

/// True for a job that still shows the fault.
using Differs = std::function<bool(const ArrayJob&)>;

/// Greedy, until nothing more can be taken away one at a time: in the result, no single cell or link less, no
/// weight, bias or start that is zero instead, or half as large, no sweep less, no threshold of zero, no
/// neuron of every cell less, and none of the array's settings made plain still differs. `job` itself must
/// differ; every job tried is one that spec::validate accepts. Stops early, with the best so far, after
/// `most_trials`.
ArrayJob shrink(ArrayJob job, const Differs& differs, std::uint64_t most_trials = 100'000);

/// The job without a cell, or without neuron p of every cell, or without the link between two cells: rows
/// close up.
ArrayJob without_cells(const ArrayJob& job, std::uint32_t first, std::uint32_t count);
ArrayJob without_component(const ArrayJob& job, int p);
ArrayJob without_link(const ArrayJob& job, std::uint32_t a, std::uint32_t b);

} // namespace hopmesh::cosim
