// Assembling the stiffness matrix.
#include "sim/rivals/stiffness.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::rivals {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

int place(const Sparse& matrix, Eigen::Index row, Eigen::Index column) {
  if (row < 0 || column < 0 || row < column) return -1;
  const int* const rows = matrix.innerIndexPtr();
  const int *const begin = rows + matrix.outerIndexPtr()[column], *const end =
                                                                      rows +
                                                                      matrix.outerIndexPtr()[column + 1];
  return static_cast<int>(std::lower_bound(begin, end, static_cast<int>(row)) - rows);
}

// 2 alpha (1 - (L/l)(1 - w w')) for the spring that spans u.
void spring_block(const scene::Spring& spring, const double (&u)[3], bool projected, double (&block)[3][3]) {
  const double length = std::max(std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]), shortest_spring);
  const double k = 2 * spring.weight, ratio = spring.rest_length / length;
  const double sideways = k * (1 - (projected ? std::min(ratio, 1.0) : ratio));
  const double along = (k - sideways) / length / length;
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) block[p][q] = (p == q ? sideways : 0) + along * u[p] * u[q];
}

} // namespace

Stiffness::Stiffness(const Physics& physics) : physics_(physics) {
  const Eigen::Index nodes = physics.nodes();
  std::vector<Eigen::Index> number(3 * nodes, -1); // node by node: blocks of a spring stay together
  for (Eigen::Index node = 0; node < nodes; ++node)
    for (int p = 0; p < 3; ++p) {
      const Eigen::Index at = p * nodes + node;
      if (physics.inverse_mass()[at] == 0) continue;
      number[3 * node + p] = freedoms();
      where_.push_back(at);
    }
  Triplets pattern;
  const auto note = [&](Eigen::Index row, Eigen::Index column) {
    if (row >= column && column >= 0) pattern.emplace_back(row, column, 0.0);
  };
  for (Eigen::Index node = 0; node < nodes; ++node)
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) note(number[3 * node + p], number[3 * node + q]);
  for (const scene::Spring& spring : physics.springs())
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) note(number[3 * spring.node[1] + p], number[3 * spring.node[0] + q]);
  matrix_.resize(freedoms(), freedoms());
  matrix_.setFromTriplets(pattern.begin(), pattern.end());
  for (const scene::Spring& spring : physics.springs()) {
    Places& places = places_.emplace_back();
    const Eigen::Index from = 3 * spring.node[0], to = 3 * spring.node[1];
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) {
        places.from[p][q] = place(matrix_, number[from + p], number[from + q]);
        places.to[p][q] = place(matrix_, number[to + p], number[to + q]);
        places.between[p][q] = place(matrix_, number[to + p], number[from + q]);
      }
  }
  for (Eigen::Index at = 0; at < freedoms(); ++at) diagonal_.push_back(place(matrix_, at, at));
}

void Stiffness::add(const Places& places, const double (&block)[3][3]) {
  double* const value = matrix_.valuePtr();
  for (int p = 0; p < 3; ++p)
    for (int q = 0; q < 3; ++q) {
      if (places.from[p][q] >= 0) value[places.from[p][q]] += block[p][q];
      if (places.to[p][q] >= 0) value[places.to[p][q]] += block[p][q];
      if (places.between[p][q] >= 0) value[places.between[p][q]] -= block[p][q];
    }
}

void Stiffness::assemble(In position, double diagonal, bool projected) {
  const Eigen::Index nodes = physics_.nodes();
  matrix_.coeffs().setZero();
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const scene::Spring& spring = physics_.springs()[s];
    double u[3], block[3][3];
    for (int p = 0; p < 3; ++p)
      u[p] = position[p * nodes + spring.node[1]] - position[p * nodes + spring.node[0]];
    spring_block(spring, u, projected, block);
    add(places_[s], block);
  }
  for (const int at : diagonal_) matrix_.valuePtr()[at] += diagonal;
}

void Stiffness::gather(const Vector& all, Vector& free) const {
  free.resize(freedoms());
  for (Eigen::Index at = 0; at < freedoms(); ++at) free[at] = all[where_[at]];
}

void Stiffness::scatter(const Vector& free, Vector& all) const {
  for (Eigen::Index at = 0; at < freedoms(); ++at) all[where_[at]] = free[at];
}

} // namespace hopmesh::rivals
