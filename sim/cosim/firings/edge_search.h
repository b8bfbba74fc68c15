// Firings made up: one for each edge that an array can show, and any number at random.
#pragma once

#include "sim/cosim/firings/firing_columns.h"
#include "sim/cosim/random_job.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

inline constexpr int lines_of_an_edge = 4; ///< that are looked for

/// Every edge that was found, at most `lines_of_an_edge` lines for each, unless a line shows several. The
/// search is the same for the same array. Steps and edges are filled in; sweep is 0, neurons count from 0.
std::vector<Firing> edge_firings(const NeuronShape& shape, const levels::OpenNeuron& neuron);

/// Corners far more often than chance would bring them; the neuron is tap 0 of its row.
spec::FiringInputs random_inputs(Dice& dice, const NeuronShape& shape, const levels::OpenNeuron& neuron);

/// L of a neuron that shows `state`, which is its V or, with momentum, its Y.
std::int32_t link_of(const levels::OpenNeuron& neuron, std::int32_t state);
/// The firing of these inputs, with its steps and edges.
Firing fired(const NeuronShape& shape, const levels::OpenNeuron& neuron, spec::FiringInputs inputs);

} // namespace hopmesh::cosim
