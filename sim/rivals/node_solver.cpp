// Factorising the constant matrix, and substitution for three right-hand sides at once.
#include "sim/rivals/node_solver.h"

#include <Eigen/SparseCholesky>

namespace hopmesh::rivals {
namespace {

bool is_free(const Physics& physics, Eigen::Index node) { // x moves in planar meshes too
  return physics.inverse_mass()[node] != 0;
}

Eigen::SparseMatrix<double> laplacian(const Physics& physics, const std::vector<Eigen::Index>& number,
                                      Eigen::Index unknowns, double inertia) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index at = 0; at < unknowns; ++at) entries.emplace_back(at, at, inertia);
  for (const scene::Spring& spring : physics.springs()) {
    const Eigen::Index from = number[spring.node[0]], to = number[spring.node[1]];
    const double k = 2 * spring.weight;
    if (from >= 0) entries.emplace_back(from, from, k);
    if (to >= 0) entries.emplace_back(to, to, k);
    if (from >= 0 && to >= 0) entries.emplace_back(to, from, -k);
  }
  Eigen::SparseMatrix<double> lower(unknowns, unknowns);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

} // namespace

NodeSolver::NodeSolver(const Physics& physics, double inertia) : physics_(physics) {
  std::vector<Eigen::Index> number(physics.nodes(), -1), nodes;
  for (Eigen::Index node = 0; node < physics.nodes(); ++node)
    if (is_free(physics, node)) {
      number[node] = static_cast<Eigen::Index>(nodes.size());
      nodes.push_back(node);
    }
  const auto unknowns = static_cast<Eigen::Index>(nodes.size());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(
      laplacian(physics, number, unknowns, inertia));
  factor_ = solver.matrixL().nestedExpression();
  inverse_pivot_ = solver.vectorD().cwiseInverse();
  node_.resize(unknowns);
  const bool in_order = solver.permutationP().size() == 0;
  for (Eigen::Index at = 0; at < unknowns; ++at)
    node_[in_order ? at : solver.permutationP().indices()[at]] = nodes[at];
  value_.resize(unknowns, Three::Zero());
}

// L D L' z = r, column by column down and up again; the unit diagonal of L is not stored.
void NodeSolver::eliminate() {
  const double* const l = factor_.valuePtr();
  const int *const row = factor_.innerIndexPtr(), *const start = factor_.outerIndexPtr();
  const Eigen::Index unknowns = factor_.cols();
  for (Eigen::Index column = 0; column < unknowns; ++column) {
    const Three known = value_[column];
    for (int at = start[column]; at < start[column + 1]; ++at) value_[row[at]] -= l[at] * known;
  }
  for (Eigen::Index column = unknowns - 1; column >= 0; --column) {
    Three sum = value_[column] * inverse_pivot_[column];
    for (int at = start[column]; at < start[column + 1]; ++at) sum -= l[at] * value_[row[at]];
    value_[column] = sum;
  }
}

void NodeSolver::solve(Vector& all) {
  const Eigen::Index nodes = physics_.nodes();
  for (std::size_t at = 0; at < node_.size(); ++at)
    value_[at] = Three(all[node_[at]], all[nodes + node_[at]], all[2 * nodes + node_[at]], 0);
  eliminate();
  all.setZero();
  for (std::size_t at = 0; at < node_.size(); ++at)
    for (Eigen::Index p = 0; p < 3; ++p) all[p * nodes + node_[at]] = value_[at][p];
}

} // namespace hopmesh::rivals
