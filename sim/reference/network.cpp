// From energy to network, the paper's: the second-order expansion of E about V0, as weights and bias
// (docs/method/theory.md, section 2).
#include "sim/reference/assembly.h"

namespace hopmesh::reference {
namespace {

// B_i and b_i. Where V0 has no direction, beta (1 - |V|)^2 is replaced by beta |V - m|^2 with the default
// direction m: equal at V = 0, nowhere below, and without the curvature -1/F that has no limit there.
Expansion expand_unit_length(double beta, const Vector3& V0) {
  const double F = V0.norm();
  if (F < shortest_direction) return {2 * beta * Block::Identity(), 2 * beta * (V0 - default_direction())};
  const Vector3 m = V0 / F;
  const Block across = Block::Identity() - m * m.transpose();
  return {2 * beta * (Block::Identity() - across / F), 2 * beta * (F - 1) * m};
}

} // namespace

// The paper's T1 to T4 and I, corrected (docs/method/theory.md, sections 2 and 6).
Network network(const scene::Mesh& mesh, const StepParameters& motion, const Vector& predicted,
                const Vector& V0) {
  const double h = motion.time_step * motion.time_step / 2;
  const Vector beta = node_beta(mesh, motion);
  Assembly assembly(mesh);
  for (const scene::Spring& spring : mesh.springs) {
    const auto [i, j] = spring.node;
    const Vector3 u = at(predicted, i) - at(predicted, j) + h * (output(mesh, V0, i) - output(mesh, V0, j));
    assembly.add_spring(spring, expand_spring(mesh, spring, h, u, Compressed::as_it_is));
  }
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node)
    assembly.add_node(node, expand_unit_length(beta[node], output(mesh, V0, node)));
  return assembly.network(V0);
}

} // namespace hopmesh::reference
