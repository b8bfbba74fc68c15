// Where a run's distance from the truth comes from: a chain of motions from the run to the truth, each of
// which mends one thing of the one before. What two neighbours differ by is that thing's part.
#pragma once

#include "sim/run/snapshots.h"

#include <optional>
#include <string>

namespace hopmesh::study {

/// A part of an error. Parts are vectors and need not point the same way: `share` is the projection on the
/// whole error over its length, so that shares add up to 1, though some may be negative; norms need not add
/// up.
struct BudgetPart {
  double norm = 0; ///< rms over nodes, m
  double share = 0;
};

struct BudgetAt {
  double time = 0;                   ///< s
  double total = 0;                  ///< rms of the run's distance from the truth, m
  double floor = 0;                  ///< how far the truth itself is known, m
  std::optional<double> sensitivity; ///< what two references that start a last place apart differ by, m
  std::vector<BudgetPart> parts;
};

/// `chain`: positions at one time, of the run first, of the truth last. Where the run stands on the truth all
/// shares are 0.
BudgetAt budget_of(const std::vector<const run::Positions*>& chain);

} // namespace hopmesh::study
