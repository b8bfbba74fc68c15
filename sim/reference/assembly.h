// Second-order expansions of energy terms, gathered into weights and bias (docs/method/theory.md, section 2).
// W is symmetric to the last bit: each 3x3 block is, and both ends of a spring get the same one.
#pragma once

#include "sim/reference/components.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hopmesh::reference {

using Block = Eigen::Matrix3d;

/// Second and first derivative of one term of E.
struct Expansion {
  Block curvature;
  Vector3 slope;
};

/// How a compressed spring's curvature across itself, which is negative, is taken.
enum class Compressed { as_it_is, as_none };

/// The expansion of a constant pull: T sqrt(l^2 + floor^2), whose curvature is nowhere negative.
inline Expansion expand_tension(double T, double floor, double h, const Vector3& u) {
  const double smoothed = std::sqrt(u.squaredNorm() + floor * floor);
  const Vector3 w = u / smoothed;
  return {T * h * h / smoothed * (Block::Identity() - w * w.transpose()), T * h * w};
}

/// S_e and f_e of a spring that is u long and moves by h times its outputs. At length 0 it has no direction:
/// only the part of it that needs none, that of L = 0, is kept.
inline Expansion expand_spring(const scene::Mesh& mesh, const scene::Spring& spring, double h,
                               const Vector3& u, Compressed compressed) {
  if (mesh.law == scene::SpringLaw::tension) return expand_tension(spring.weight, mesh.floor, h, u);
  const double length = u.norm();
  const double ratio = length > 0 ? spring.rest_length / length : 0;
  const double curved = compressed == Compressed::as_none ? std::min(ratio, 1.0) : ratio;
  const Vector3 w = length > 0 ? Vector3(u / length) : Vector3::Zero();
  const Block across = Block::Identity() - w * w.transpose();
  return {2 * spring.weight * h * h * (Block::Identity() - curved * across),
          2 * spring.weight * h * (1 - ratio) * u};
}

/// Gathers Hessian and gradient of E over the free nodes.
class Assembly {
 public:
  explicit Assembly(const scene::Mesh& mesh)
      : mesh_(mesh), gradient_(Vector::Zero(components(mesh) * nodes_of(mesh))),
        diagonal_(mesh.nodes(), Block::Zero()), first_(most_neighbours(mesh)), count_(mesh.nodes(), 0),
        links_(first_.back()) {}

  void add_spring(const scene::Spring& spring, const Expansion& term) {
    const auto [i, j] = spring.node;
    add_node(i, term);
    add_node(j, {term.curvature, -term.slope});
    if (mesh_.pinned[i] || mesh_.pinned[j]) return;
    link(i, j, term.curvature);
    link(j, i, term.curvature);
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
      if (!mesh_.pinned[node]) link(node, node, -diagonal_[node]);
    Network network{weights(), {}};
    network.I = -(network.W * V0) - gradient_;
    return network;
  }

 private:
  /// What another node, or the node itself, does to a node.
  struct Link {
    Eigen::Index from;
    Block weight;
  };

  /// Where each node's links begin, and the end: room for one to each end of its springs and to itself.
  static std::vector<std::size_t> most_neighbours(const scene::Mesh& mesh) {
    std::vector<std::size_t> first(mesh.nodes() + 1, 1);
    first[0] = 0;
    for (const scene::Spring& spring : mesh.springs)
      for (const std::uint32_t node : spring.node) ++first[node + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
  }

  // In the order of the columns. Two springs between the same nodes make a single block.
  void link(Eigen::Index node, Eigen::Index from, const Block& weight) {
    Link *const begin = &links_[first_[node]], *at = begin + count_[node];
    while (at != begin && at[-1].from >= from) --at;
    Link* const end = begin + count_[node];
    if (at != end && at->from == from) {
      at->weight += weight;
      return;
    }
    std::copy_backward(at, end, end + 1);
    *at = {from, weight};
    ++count_[node];
  }

  // Row by row, as the matrix keeps them. Zeros are kept: which weights exist follows from the mesh alone,
  // not from where it happens to be.
  Matrix weights() const {
    const Eigen::Index n = components(mesh_);
    const std::size_t blocks = std::accumulate(count_.begin(), count_.end(), std::size_t{0});
    Matrix W(gradient_.size(), gradient_.size());
    W.resizeNonZeros(static_cast<Eigen::Index>(blocks) * n * n);
    auto *start = W.outerIndexPtr(), *column = W.innerIndexPtr();
    double* value = W.valuePtr();
    for (std::size_t node = 0; node < count_.size(); ++node)
      for (Eigen::Index p = 0; p < n; ++p, ++start) {
        const Link *link = links_.data() + first_[node], *const end = link + count_[node];
        for (; link != end; ++link)
          for (Eigen::Index q = 0; q < n; ++q) {
            *column++ = static_cast<Matrix::StorageIndex>(row(mesh_, link->from, q));
            *value++ = link->weight(axis(mesh_, p), axis(mesh_, q));
          }
        start[1] = static_cast<Matrix::StorageIndex>(value - W.valuePtr());
      }
    return W;
  }

  const scene::Mesh& mesh_;
  Vector gradient_;
  std::vector<Block, Eigen::aligned_allocator<Block>> diagonal_;
  const std::vector<std::size_t> first_;
  std::vector<std::size_t> count_;
  std::vector<Link, Eigen::aligned_allocator<Link>> links_;
};

} // namespace hopmesh::reference
