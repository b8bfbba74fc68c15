// The energies: what the springs hold, and what a step minimises (docs/method/theory.md, section 1).
#include "sim/reference/components.h"

namespace hopmesh::reference {

// Paper eq. 4.
double spring_energy(const scene::Mesh& mesh, const Vector& position) {
  double sum = 0;
  for (const scene::Spring& spring : mesh.springs)
    sum += spring_term(mesh, spring, at(position, spring.node[0]), at(position, spring.node[1]));
  return sum;
}

// docs/method/theory.md, section 2: the weight of the unit-length term, in the units of the spring terms (h^2
// alpha ~ dt^4).
Vector node_beta(const scene::Mesh& mesh, const StepParameters& motion) {
  Vector sum = Vector::Zero(nodes_of(mesh)), count = Vector::Zero(nodes_of(mesh));
  for (const scene::Spring& spring : mesh.springs)
    for (const std::uint32_t node : spring.node) {
      sum[node] += spring.weight;
      count[node] += 1;
    }
  const double dt2 = motion.time_step * motion.time_step;
  return motion.beta * dt2 * dt2 * sum.cwiseQuotient(count.cwiseMax(1));
}

namespace {

// C_i + h V_i of every node: where the outputs V would put the mesh (paper eq. 5 with V for the change of a).
Vector displaced(const scene::Mesh& mesh, double h, const Vector& predicted, const Vector& V) {
  Vector position = predicted;
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) at(position, node) += h * output(mesh, V, node);
  return position;
}

} // namespace

// docs/method/theory.md, section 1; paper eq. 15. Pinned nodes have no neurons, so no unit-length term
// either.
double energy(const scene::Mesh& mesh, const StepParameters& motion, const Vector& predicted,
              const Vector& V) {
  const double h = motion.time_step * motion.time_step / 2;
  double sum = spring_energy(mesh, displaced(mesh, h, predicted, V));
  const Vector beta = node_beta(mesh, motion);
  for (Eigen::Index node = 0; node < nodes_of(mesh); ++node) {
    if (mesh.pinned[node]) continue;
    const double short_of_one = 1 - output(mesh, V, node).norm();
    sum += beta[node] * short_of_one * short_of_one;
  }
  return sum;
}

// Paper eq. 3.
double network_energy(const Network& network, const Vector& V) {
  return -0.5 * V.dot(network.W * V) - network.I.dot(V);
}

} // namespace hopmesh::reference
