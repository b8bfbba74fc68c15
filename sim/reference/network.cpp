// From energy to network: the second-order expansion of E about V0, as weights and bias (docs/theory.md,
// section 2). W is symmetric to the last bit: each 3x3 block is, and both ends of a spring get the same one.
#include "sim/reference/components.h"

namespace hopmesh::reference {
namespace {

using Block = Eigen::Matrix3d;

/// Second and first derivative of one term of E.
struct Expansion {
  Block curvature;
  Vector3 slope;
};

// S_e and f_e. At length 0 the spring has no direction: only the part of it that needs none, that of L = 0,
// is kept.
Expansion expand_spring(const scene::Spring& spring, double h, const Vector3& u) {
  const double length = u.norm();
  const double ratio = length > 0 ? spring.rest_length / length : 0;
  const Vector3 w = length > 0 ? Vector3(u / length) : Vector3::Zero();
  const Block across = Block::Identity() - w * w.transpose();
  return {2 * spring.weight * h * h * (Block::Identity() - ratio * across),
          2 * spring.weight * h * (1 - ratio) * u};
}

// B_i and b_i. Where V0 has no direction, beta (1 - |V|)^2 is replaced by beta |V - m|^2 with the default
// direction m: equal at V = 0, nowhere below, and without the curvature -1/F that has no limit there.
Expansion expand_unit_length(double beta, const Vector3& V0) {
  const double F = V0.norm();
  if (F < shortest_direction) return {2 * beta * Block::Identity(), 2 * beta * (V0 - default_direction())};
  const Vector3 m = V0 / F;
  const Block across = Block::Identity() - m * m.transpose();
  return {2 * beta * (Block::Identity() - across / F), 2 * beta * (F - 1) * m};
}

/// Gathers Hessian and gradient of E over the free nodes.
class Assembly {
 public:
  explicit Assembly(const scene::Mesh& mesh)
      : mesh_(mesh), gradient_(Vector::Zero(components(mesh) * nodes_of(mesh))),
        diagonal_(mesh.nodes(), Block::Zero()) {}

  void add_spring(const scene::Spring& spring, const Expansion& term) {
    const auto [i, j] = spring.node;
    add_node(i, term);
    add_node(j, {term.curvature, -term.slope});
    if (mesh_.pinned[i] || mesh_.pinned[j]) return;
    add_weights(i, j, term.curvature);
    add_weights(j, i, term.curvature);
  }

  void add_node(Eigen::Index node, const Expansion& term) {
    if (mesh_.pinned[node]) return;
    diagonal_[node] += term.curvature;
    for (Eigen::Index p = 0; p < components(mesh_); ++p)
      gradient_[row(mesh_, node, p)] += term.slope[axis(mesh_, p)];
  }

  // W = -H, I = H V0 - g.
  Network network(const Vector& V0) {
    for (Eigen::Index node = 0; node < nodes_of(mesh_); ++node)
      if (!mesh_.pinned[node]) add_weights(node, node, -diagonal_[node]);
    Matrix W(gradient_.size(), gradient_.size());
    W.setFromTriplets(weights_.begin(), weights_.end());
    Vector I = -(W * V0) - gradient_;
    return {W, std::move(I)};
  }

 private:
  // Zeros are kept: which weights exist follows from the mesh alone, not from where it happens to be.
  void add_weights(Eigen::Index i, Eigen::Index j, const Block& block) {
    for (Eigen::Index p = 0; p < components(mesh_); ++p)
      for (Eigen::Index q = 0; q < components(mesh_); ++q)
        weights_.emplace_back(row(mesh_, i, p), row(mesh_, j, q), block(axis(mesh_, p), axis(mesh_, q)));
  }

  const scene::Mesh& mesh_;
  Vector gradient_;
  std::vector<Block, Eigen::aligned_allocator<Block>> diagonal_;
  std::vector<Eigen::Triplet<double>> weights_;
};

} // namespace

// The paper's T1 to T4 and I, corrected (docs/theory.md, sections 2 and 6).
Network network(const scene::Mesh& mesh, const Motion& motion, const Vector& predicted, const Vector& V0) {
  const double h = motion.time_step * motion.time_step / 2;
  const Vector beta = node_beta(mesh, motion);
  Assembly assembly(mesh);
  for (const scene::Spring& spring : mesh.springs) {
    const auto [i, j] = spring.node;
    const Vector3 u = at(predicted, i) - at(predicted, j) + h * (output(mesh, V0, i) - output(mesh, V0, j));
    assembly.add_spring(spring, expand_spring(spring, h, u));
  }
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    assembly.add_node(node, expand_unit_length(beta[node], output(mesh, V0, node)));
  return assembly.network(V0);
}

} // namespace hopmesh::reference
