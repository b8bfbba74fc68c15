#include "sim/study/error_budget.h"

namespace hopmesh::study {

namespace {

// Of the vectors a - b and c - d.
double product(const Positions& a, const Positions& b, const Positions& c, const Positions& d) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (c[k] - d[k]);
  return sum;
}

} // namespace

BudgetAt budget_of(const std::vector<const Positions*>& chain) {
  const Positions &run = *chain.front(), &truth = *chain.back();
  const double square = product(run, truth, run, truth);
  BudgetAt budget;
  budget.total = rms_distance(run, truth);
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    const Positions &before = *chain[k], &after = *chain[k + 1];
    const double along = product(before, after, run, truth);
    budget.parts.push_back({rms_distance(before, after), square > 0 ? along / square : 0});
  }
  return budget;
}

} // namespace hopmesh::study
