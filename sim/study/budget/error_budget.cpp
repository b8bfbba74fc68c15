#include "sim/study/budget/error_budget.h"

namespace hopmesh::study {

namespace {

// Of the vectors a - b and c - d.
double product(const run::Positions& a, const run::Positions& b, const run::Positions& c,
               const run::Positions& d) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (c[k] - d[k]);
  return sum;
}

} // namespace

BudgetAt budget_of(const std::vector<const run::Positions*>& chain) {
  const run::Positions &run = *chain.front(), &truth = *chain.back();
  const double square = product(run, truth, run, truth);
  BudgetAt budget;
  budget.total = run::rms_distance(run, truth);
  for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
    const run::Positions &before = *chain[k], &after = *chain[k + 1];
    const double along = product(before, after, run, truth);
    budget.parts.push_back({run::rms_distance(before, after), square > 0 ? along / square : 0});
  }
  return budget;
}

} // namespace hopmesh::study
