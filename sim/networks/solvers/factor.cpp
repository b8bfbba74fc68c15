#include "sim/networks/solvers/factor.h"

#include <numeric>

namespace hopmesh::solvers {

std::vector<Eigen::Index> all_outputs(const Problem& problem) {
  std::vector<Eigen::Index> all(problem.I.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

bool is_convex(const Problem& problem) {
  return Factor(problem.W, all_outputs(problem), 0).positive();
}

} // namespace hopmesh::solvers
