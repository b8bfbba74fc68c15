// How sure an answer to a step's network is: its error as measured, as one solve tells it, and as the formats
// bound it beforehand (docs/method/theory.md, section 10).
#pragma once

#include "sim/levels/networks/error_bound.h"
#include "sim/networks/solvers/problem.h"

namespace hopmesh::networks {

struct Certainty {
  double measured = 0;             ///< rms of V against the answer, over the neurons that have weights
  std::optional<double> told = {}; ///< by one solve; none where the network is not definite
  std::size_t held = 0; ///< outputs at bounds, or that the solve takes there: then told is an estimate
  std::optional<levels::ErrorBound> bound = {};
};

/// Of outputs V over all neurons of the problem. Bounds: none without a rule.
Certainty certainty_of(const solvers::Problem& problem, const solvers::Vector& V,
                       const levels::ErrorBounds& bounds, const spec::ArraySpec& array,
                       const std::optional<levels::RunRules>& rules);

/// "1.2e-4 rms from the answer; one solve tells 1.2e-4", and what the formats say.
std::string told_text(const Certainty& certainty);
std::string bound_text(const std::optional<levels::ErrorBound>& bound);

} // namespace hopmesh::networks
