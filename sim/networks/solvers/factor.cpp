#include "sim/networks/solvers/factor.h"

#include <numeric>

namespace hopmesh::solvers {

Factor::Factor(const Problem& problem, const std::vector<Eigen::Index>& outputs, double shift) {
  std::vector<Eigen::Index> place(problem.I.size(), -1);
  for (std::size_t k = 0; k < outputs.size(); ++k) place[outputs[k]] = static_cast<Eigen::Index>(k);
  std::vector<Eigen::Triplet<double>> lower;
  for (const Eigen::Index i : outputs) {
    lower.emplace_back(place[i], place[i], shift);
    for (Weights::InnerIterator w(problem.W, i); w; ++w)
      if (place[w.col()] >= 0 && place[w.col()] <= place[i])
        lower.emplace_back(place[i], place[w.col()], -w.value());
  }
  const auto n = static_cast<Eigen::Index>(outputs.size());
  Eigen::SparseMatrix<double> part(n, n);
  part.setFromTriplets(lower.begin(), lower.end());
  solver_.compute(part);
  positive_ = n == 0 || (solver_.info() == Eigen::Success && solver_.vectorD().minCoeff() > 0);
}

std::vector<Eigen::Index> all_outputs(const Problem& problem) {
  std::vector<Eigen::Index> all(problem.I.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

bool is_convex(const Problem& problem) {
  return Factor(problem, all_outputs(problem), 0).positive();
}

} // namespace hopmesh::solvers
