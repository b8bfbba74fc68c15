// Corrections of an answer by its residual (docs/method/theory.md, section 9), in double and for readers: the
// neurons' rule answers to what is left, and its answer is added.
#pragma once

#include "sim/reference/relaxation.h"

namespace hopmesh::reference {

/// What came of a step's corrections.
struct Refinement {
  std::uint32_t corrections = 0; ///< that were kept
  std::uint32_t refused = 0;     ///< those that would have raised the energy
  double residual = 0;           ///< largest |s| of neurons that may still move, over the largest |I|
};

/// Corrects what a relaxation from V0 came to, at most so often; sweeps add up.
Refinement refine(const Network& network, const Order& order, const Vector& V0, const Stop& stop,
                  const NeuronRule& rule, std::uint32_t most, Relaxation& answer);

} // namespace hopmesh::reference
