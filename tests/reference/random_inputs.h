// Random meshes, outputs and networks, the same on every machine: the standard's engine with our own
// distributions.
#pragma once

#include "sim/reference/reference.h"

#include <cstdlib>
#include <iostream>
#include <random>

namespace hopmesh::tests {

/// A stream of random numbers that prints its seed; HOPMESH_TEST_SEED replaces the seed a test was written
/// with.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    if (const char* given = std::getenv("HOPMESH_TEST_SEED")) seed = std::strtoull(given, nullptr, 0);
    std::cout << "seed " << seed << "\n";
    engine_.seed(seed);
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  bool chance(double p) { return between(0, 1) < p; }

 private:
  std::mt19937_64 engine_;
};

/// Nodes a unit apart, give or take; the springs of a ring (so that none is without) and random chords; node
/// 0 and a few more pinned, the last one free.
inline scene::Mesh random_mesh(Random& random, std::uint32_t nodes, bool planar, double rest_factor = 1) {
  scene::Mesh mesh;
  mesh.planar = planar;
  for (std::uint32_t n = 0; n < nodes; ++n) {
    const double y = planar ? 0.25 : random.between(-0.4, 0.4);
    mesh.position.push_back({n % 3 + random.between(-0.3, 0.3), y, n / 3 + random.between(-0.3, 0.3)});
    mesh.pinned.push_back(n == 0 || (n + 1 < nodes && random.chance(0.2)));
  }
  for (std::uint32_t i = 0; i < nodes; ++i)
    for (std::uint32_t j = i + 1; j < nodes; ++j)
      if (j == i + 1 || (i == 0 && j + 1 == nodes) || random.chance(0.3))
        mesh.springs.push_back(
            {{i, j}, random.between(0.2, 20), rest_factor == 0 ? 0 : rest_factor * random.between(0.5, 1.5)});
  return mesh;
}

inline reference::StepParameters random_motion(Random& random) {
  const double steps[] = {0.01, 0.05, 0.2, 1.0};
  reference::StepParameters motion{};
  motion.time_step = steps[random.below(4)];
  motion.friction = 0.99;
  motion.gamma = random.between(0.1, 10);
  motion.beta = random.chance(0.2) ? 0 : random.between(0.1, 10);
  motion.acceleration_memory = random.between(0, 1);
  motion.energy_of_all_springs = random.chance(0.5);
  motion.force_on_acceleration = random.chance(0.5);
  motion.force = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  motion.threshold = 1e-6;
  motion.max_sweeps = 300;
  motion.expansions = 1;
  return motion;
}

inline Eigen::Index components(const scene::Mesh& mesh) {
  return mesh.planar ? 2 : 3;
}

/// Outputs anywhere in the box but at least `shortest` long; 0 where pinned.
inline reference::Vector random_outputs(Random& random, const scene::Mesh& mesh, double shortest = 0.2) {
  const Eigen::Index k = components(mesh);
  reference::Vector V = reference::Vector::Zero(k * static_cast<Eigen::Index>(mesh.nodes()));
  for (std::size_t node = 0; node < mesh.nodes(); ++node)
    while (!mesh.pinned[node] && V.segment(k * node, k).norm() < shortest)
      for (Eigen::Index p = 0; p < k; ++p) V[k * node + p] = random.between(-1, 1);
  return V;
}

/// A moving mesh in the middle of a run: everything but the pinned nodes has velocity, acceleration and a
/// rest state.
inline reference::State random_state(Random& random, const scene::Mesh& mesh, double speed = 0.2) {
  reference::State state = reference::initial_state(mesh);
  for (Eigen::Index k = 0; k < state.velocity.size(); ++k) {
    if (mesh.pinned[k / 3] || (mesh.planar && k % 3 == 1)) continue;
    state.velocity[k] = random.between(-speed, speed);
    state.acceleration[k] = random.between(-speed, speed);
  }
  state.V = random_outputs(random, mesh);
  state.step = 7;
  return state;
}

/// A symmetric network of n neurons, sparse, with a diagonal of any sign and some neurons without any input.
inline reference::Network random_network(Random& random, Eigen::Index n) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(n, n);
  reference::Vector I = reference::Vector::Zero(n);
  const double density = random.between(0, 1), diagonal = random.between(0, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (random.chance(0.05)) continue;
    W(i, i) = random.chance(0.8) ? diagonal * random.between(-1, 1) : 0;
    I[i] = random.chance(0.8) ? random.between(-1, 1) : 0;
    for (Eigen::Index j = 0; j < i; ++j)
      if (random.chance(density)) W(i, j) = W(j, i) = random.between(-1, 1);
  }
  return {W.sparseView(), I};
}

inline reference::Network network_of(const Eigen::MatrixXd& W, const reference::Vector& I) {
  return {W.sparseView(), I};
}

/// A start in the box, often at its bounds: there the rule changes sides.
inline reference::Vector random_point(Random& random, Eigen::Index n) {
  reference::Vector V(n);
  for (double& v : V) v = random.chance(0.3) ? (random.chance(0.5) ? 1 : -1) : random.between(-1, 1);
  return V;
}

inline reference::Order one_by_one(Eigen::Index neurons) {
  reference::Order order;
  for (Eigen::Index n = 0; n < neurons; ++n) order.push_back({static_cast<std::uint32_t>(n)});
  return order;
}

/// Greedy colouring: neurons of a phase share no weight.
inline reference::Order coloured(const reference::Matrix& W) {
  reference::Order order;
  std::vector<std::size_t> colour;
  for (Eigen::Index n = 0; n < W.rows(); ++n) {
    std::vector<bool> taken(order.size() + 1, false);
    for (reference::Matrix::InnerIterator w(W, n); w; ++w)
      if (w.col() < n) taken[colour[w.col()]] = true;
    const std::size_t free = std::find(taken.begin(), taken.end(), false) - taken.begin();
    if (free == order.size()) order.emplace_back();
    order[free].push_back(static_cast<std::uint32_t>(n));
    colour.push_back(free);
  }
  return order;
}

} // namespace hopmesh::tests
