// The equation of motion: who moves, what pulls.
#include "sim/rivals/physics.h"

#include "sim/scene/scene.h"

#include <cmath>

namespace hopmesh::rivals {

Vector by_node(const Vector& by_component) {
  const Eigen::Index nodes = by_component.size() / 3;
  Vector result(by_component.size());
  for (Eigen::Index node = 0; node < nodes; ++node)
    for (Eigen::Index p = 0; p < 3; ++p) result[3 * node + p] = by_component[p * nodes + node];
  return result;
}

Vector by_component(const Vector& by_node) {
  const Eigen::Index nodes = by_node.size() / 3;
  Vector result(by_node.size());
  for (Eigen::Index node = 0; node < nodes; ++node)
    for (Eigen::Index p = 0; p < 3; ++p) result[p * nodes + node] = by_node[3 * node + p];
  return result;
}

Surroundings Surroundings::of(const scene::Scene& scene) {
  Surroundings result;
  const double friction = scene.motion.friction;
  const scene::Vector3 wind = scene.force.wind.value_or(scene::Vector3{0, 0, 0});
  for (std::size_t p = 0; p < 3; ++p) result.force[p] = scene.force.gravity[p] + wind[p];
  result.drag = scene.force.drag - (friction == 1 ? 0 : std::log(friction) / scene.motion.time_step);
  return result;
}

Physics::Physics(const scene::Mesh& mesh, const Surroundings& surroundings)
    : nodes_(static_cast<Eigen::Index>(mesh.nodes())), mass_(mesh.mass), drag_(surroundings.drag),
      springs_(mesh.springs), pass_(mesh.nodes(), mesh.springs), inverse_mass_(Vector::Zero(3 * nodes_)),
      external_(Vector::Zero(3 * nodes_)) {
  initial_.position.resize(3 * nodes_);
  initial_.velocity = Vector::Zero(3 * nodes_);
  for (Eigen::Index node = 0; node < nodes_; ++node)
    for (std::size_t p = 0; p < 3; ++p) {
      const Eigen::Index at = static_cast<Eigen::Index>(p) * nodes_ + node;
      initial_.position[at] = mesh.position[node][p];
      if (mesh.pinned[node] || (mesh.planar && p == 1)) continue;
      initial_.velocity[at] = mesh.velocity[p];
      inverse_mass_[at] = 1 / mesh.mass;
      external_[at] = surroundings.force[p];
    }
}

void Physics::acceleration(In position, In velocity, Out result) const {
  spring_forces(position, result);
  result.array() = result.array() * inverse_mass_.array() + external_.array() - drag_ * velocity.array();
}

void Physics::kick(double kept, double time, In force, Out velocity) const {
  pass_.kernel().kick(velocity.size(), kept, time, force.data(), inverse_mass_.data(), external_.data(),
                      velocity.data());
}

double Physics::energy(const State& state) const {
  return mass_ * (state.velocity.squaredNorm() / 2 - external_.dot(state.position)) +
         spring_energy(state.position);
}

} // namespace hopmesh::rivals
