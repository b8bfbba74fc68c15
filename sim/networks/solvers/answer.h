// What the solvers are measured against: the exact answer, or where there is none to be had the best one
// found.
#pragma once

#include "sim/networks/solvers/problem.h"

namespace hopmesh::solvers {

struct Answer {
  Vector V, s;          ///< s = inputs(V)
  bool convex = false;  ///< then V is the only minimum, to a KKT violation of 1e-12
  double start_gap = 0; ///< E(start) - E(V)
};

/// Convex: projected Newton. Else sequential Hopfield descent to its rest, a local minimum among others. The
/// problem as reached() leaves it.
Answer best_answer(const Problem& problem);
/// Where that descent ends from V; not convex.
Answer answer_below(const Problem& problem, const Vector& V);
/// E(V) - E(answer).
double gap(const Problem& problem, const Answer& answer, const Vector& V);

} // namespace hopmesh::solvers
