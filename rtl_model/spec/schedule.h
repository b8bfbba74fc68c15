// Mesh graph -> colours -> phases: the order in which neurons fire.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/colouring.h"

#include <algorithm>

namespace hopmesh::spec {

/// Neurons are numbered cell * neurons_per_cell + p. An entry is a phase: the neurons that fire in it,
/// ascending.
using Phases = std::vector<std::vector<std::uint32_t>>;

/// Phases of one sweep. Coloured: colour by colour, within a colour component by component.
/// Sequential: one neuron a phase, in number order. Synchronous: one phase.
inline Phases phases_of(const Topology& t, Schedule schedule) {
  const std::size_t per_cell = t.neurons_per_cell;
  Phases phases;
  if (t.cells() == 0) return phases;
  if (schedule == Schedule::synchronous) {
    phases.resize(1);
    for (std::size_t i = 0; i < t.neurons(); ++i) phases[0].push_back(i);
  } else if (schedule == Schedule::sequential) {
    for (std::size_t i = 0; i < t.neurons(); ++i) phases.push_back({std::uint32_t(i)});
  } else {
    const auto colour = colour_cells(t);
    phases.resize(per_cell * (1 + *std::max_element(colour.begin(), colour.end())));
    for (std::size_t c = 0; c < t.cells(); ++c)
      for (std::size_t p = 0; p < per_cell; ++p) phases[colour[c] * per_cell + p].push_back(c * per_cell + p);
  }
  return phases;
}

/// For each neuron, the phase in which it fires.
inline std::vector<std::size_t> phase_of_neurons(const Topology& t, const Phases& phases) {
  std::vector<std::size_t> phase(t.neurons());
  for (std::size_t k = 0; k < phases.size(); ++k)
    for (std::uint32_t neuron : phases[k]) phase[neuron] = k;
  return phase;
}

} // namespace hopmesh::spec
