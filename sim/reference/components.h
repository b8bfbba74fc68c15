// How node vectors and neuron outputs are laid out: the only place that knows that a planar node has two
// neurons.
#pragma once

#include "sim/reference/reference.h"

#include <cmath>

namespace hopmesh::reference {

using Vector3 = Eigen::Vector3d;

/// A direction shorter than this has none.
constexpr double shortest_direction = 1e-9;

/// Where a node without a direction of its own looks: along -z, as a flag hangs.
inline Vector3 default_direction() {
  return -Vector3::UnitZ();
}

inline Eigen::Index nodes_of(const scene::Mesh& mesh) {
  return static_cast<Eigen::Index>(mesh.nodes());
}

/// Neurons of a node.
inline Eigen::Index components(const scene::Mesh& mesh) {
  return mesh.planar ? 2 : 3;
}

/// The coordinate that component p acts along: x, y, z, or x and z in a planar mesh, where y never moves.
inline Eigen::Index axis(const scene::Mesh& mesh, Eigen::Index p) {
  return mesh.planar ? 2 * p : p;
}

/// Row of component p of a node in V, W and I.
inline Eigen::Index row(const scene::Mesh& mesh, Eigen::Index node, Eigen::Index p) {
  return components(mesh) * node + p;
}

/// A node's entry of positions, velocities, accelerations, predictions.
inline auto at(const Vector& all, Eigen::Index node) {
  return all.segment<3>(3 * node);
}
inline auto at(Vector& all, Eigen::Index node) {
  return all.segment<3>(3 * node);
}

/// A node's outputs as a vector in space; y is 0 in a planar mesh.
inline Vector3 output(const scene::Mesh& mesh, const Vector& V, Eigen::Index node) {
  Vector3 in_space = Vector3::Zero();
  for (Eigen::Index p = 0; p < components(mesh); ++p) in_space[axis(mesh, p)] = V[row(mesh, node, p)];
  return in_space;
}

/// The reverse: writes a vector in space to a node's outputs.
inline void set_output(const scene::Mesh& mesh, Vector& V, Eigen::Index node, const Vector3& in_space) {
  for (Eigen::Index p = 0; p < components(mesh); ++p) V[row(mesh, node, p)] = in_space[axis(mesh, p)];
}

/// beta_i = beta dt^4 mean alpha of the node's springs (docs/method/theory.md, section 2); 0 for a node
/// without springs.
Vector node_beta(const scene::Mesh& mesh, const StepParameters& motion);

/// What one spring holds with its ends at p and q: alpha (|p - q| - L)^2 (paper eq. 4), or a constant pull's
/// alpha |p - q|, smoothed.
inline double spring_term(const scene::Mesh& mesh, const scene::Spring& spring, const Vector3& p,
                          const Vector3& q) {
  if (mesh.law == scene::SpringLaw::tension)
    return spring.weight * std::sqrt((p - q).squaredNorm() + mesh.floor * mesh.floor);
  const double stretch = (p - q).norm() - spring.rest_length;
  return spring.weight * stretch * stretch;
}

/// A step's network from V0, by who answers for the motion.
Relaxation answered(const StepParameters& motion, const Network& network, const Order& order,
                    const Vector& V0, std::uint64_t step);

} // namespace hopmesh::reference
