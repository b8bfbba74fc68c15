// Every firing of a run of an array, in the order of the run.
#pragma once

#include "sim/cosim/array_job.h"
#include "sim/cosim/firings/firing_columns.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

/// Called with each firing, its steps and edges filled in.
using TakeFiring = std::function<void(const Firing&)>;

/// The whole array of the level runs the job, its open neuron fires beside it, neuron by neuron. Throws
/// std::logic_error where the two do not come to the same V after a sweep. False where the user stopped it.
bool run_firings(const ArrayJob& job, const NeuronShape& shape, const levels::Level& level,
                 const levels::OpenNeuron& neuron, const TakeFiring& take);

} // namespace hopmesh::cosim
