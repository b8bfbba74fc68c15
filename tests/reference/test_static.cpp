// The static step: against a sparse factorisation where the energy is quadratic, against the hanging chain's
// closed form where it is not (docs/method/theory.md, section 4).
#include "tests/reference/random_inputs.h"
#include "tests/reference/static_motion.h"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

Eigen::Index nodes_of(const scene::Mesh& mesh) {
  return static_cast<Eigen::Index>(mesh.nodes());
}

/// Where no spring has a rest length, forces balance in a linear system, coordinate by coordinate: of every
/// free node the sum over springs of 2 alpha (x_i - x_j) is its load. Solved by Cholesky's factorisation.
Vector balanced(const scene::Mesh& mesh, const Vector& start, const Vector& load) {
  const Eigen::Index n = nodes_of(mesh);
  Vector result = start;
  for (Eigen::Index p = 0; p < 3; ++p) {
    if (mesh.planar && p == 1) continue;
    std::vector<Eigen::Triplet<double>> entries;
    Vector right = Vector::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (mesh.pinned[i]) entries.emplace_back(i, i, 1);
      right[i] = mesh.pinned[i] ? start[3 * i + p] : load[3 * i + p];
    }
    for (const scene::Spring& s : mesh.springs)
      for (int end = 0; end < 2; ++end) {
        const Eigen::Index i = s.node[end], j = s.node[1 - end];
        if (mesh.pinned[i]) continue;
        entries.emplace_back(i, i, 2 * s.weight);
        if (mesh.pinned[j])
          right[i] += 2 * s.weight * start[3 * j + p];
        else
          entries.emplace_back(i, j, -2 * s.weight);
      }
    Eigen::SparseMatrix<double> A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(A);
    const Vector x = factor.solve(right);
    for (Eigen::Index i = 0; i < n; ++i) result[3 * i + p] = x[i];
  }
  return result;
}

TEST(ReferenceStatic, OneStepOfAMeshWithoutRestLengthsSolvesItsLinearSystem) {
  Random random(71);
  for (int k = 0; k < 20; ++k) {
    const bool planar = k % 2 == 1;
    scene::Mesh mesh = random_mesh(random, 6 + random.below(8), planar, 0);
    mesh.pinned[0] = true;
    StepParameters motion = static_motion();
    motion.force = {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
    motion.node_force.resize(3 * nodes_of(mesh));
    for (double& a : motion.node_force) a = random.between(-1, 1);
    motion.mass = random.between(0.1, 2);
    State state = initial_state(mesh, *motion.formulation);
    const Vector wanted = balanced(mesh, state.position, increment(mesh, motion, state).load);
    advance(mesh, motion, one_by_one(state.V.size()), state);
    EXPECT_LT((state.position - wanted).cwiseAbs().maxCoeff(), 1e-10) << "case " << k;
    EXPECT_EQ(state.velocity.cwiseAbs().maxCoeff(), 0);
  }
}

/// `links` links of length 1 and k = 2 alpha = 400 below a pin, each with a node of 2 kg at its lower end.
scene::Mesh chain(int links) {
  scene::Mesh mesh;
  for (int i = 0; i <= links; ++i) {
    mesh.position.push_back({0, 0, -1.0 * i});
    mesh.pinned.push_back(i == 0);
    if (i > 0) mesh.springs.push_back({{std::uint32_t(i - 1), std::uint32_t(i)}, 200, 1});
  }
  mesh.mass = 2;
  return mesh;
}

// Link i carries the mass below it: it stretches by that times g / k.
Vector hanging(int links, double g) {
  Vector x = Vector::Zero(3 * (links + 1));
  for (int i = 1; i <= links; ++i) x[3 * i + 2] = x[3 * (i - 1) + 2] - (1 + (links - i + 1) * 2.0 * g / 400);
  return x;
}

TEST(ReferenceStatic, AChainComesToHangAsItsClosedFormSays) {
  const double g = 9.81;
  for (const double aside : {0.0, 0.8}) { // straight down, and a zigzag off the line
    scene::Mesh mesh = chain(6);
    for (std::size_t i = 1; i < mesh.nodes(); ++i) mesh.position[i][0] = i % 2 ? aside : -aside / 3;
    StepParameters motion = static_motion();
    motion.mass = mesh.mass;
    motion.force = {0, 0, -g};
    State state = initial_state(mesh, *motion.formulation);
    double before = HUGE_VAL;
    for (int step = 0; step < 60; ++step) {
      advance(mesh, motion, one_by_one(state.V.size()), state);
      double energy = spring_energy(mesh, state.position);
      for (std::size_t i = 1; i < mesh.nodes(); ++i) energy += 2 * g * state.position[3 * i + 2];
      EXPECT_LE(energy, before + 1e-9) << "step " << step << ", aside " << aside;
      before = energy;
    }
    EXPECT_LT((state.position - hanging(6, g)).cwiseAbs().maxCoeff(), 1e-9) << "aside " << aside;
  }
}

// What a chain of links at their natural length offers sideways is nothing: a step must not go for ever.
TEST(ReferenceStatic, AStepAgainstNothingGoesNoFurtherThanTheLongestSpring) {
  scene::Mesh mesh = chain(6);
  StepParameters motion = static_motion();
  motion.force = {5, 0, 0};
  State state = initial_state(mesh, *motion.formulation);
  const Vector start = state.position;
  advance(mesh, motion, one_by_one(state.V.size()), state);
  EXPECT_GT((state.position - start).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LE((state.position - start).cwiseAbs().maxCoeff(), 1);
}

TEST(ReferenceStatic, TheNetworkHasTheSlopeOfThePotential) {
  Random random(72);
  for (int k = 0; k < 20; ++k) {
    scene::Mesh mesh = random_mesh(random, 6, k % 2 == 1, k % 3);
    if (k % 4 == 3) mesh.law = scene::SpringLaw::tension, mesh.floor = 0.1;
    StepParameters motion = static_motion();
    motion.force = {0.3, -0.2, -1};
    const State state = random_state(random, mesh);
    const Increment about = increment(mesh, motion, state);
    const Vector V0 = random_outputs(random, mesh);
    const double scale = 0.25, d = 1e-5;
    const Network net = network(mesh, about, scale, V0);
    const Vector slope = -(net.W * V0) - net.I;
    for (Eigen::Index row = 0; row < slope.size(); ++row) {
      if (mesh.pinned[row / components(mesh)]) continue;
      Vector up = V0, down = V0;
      up[row] += d, down[row] -= d;
      const double wanted = (energy(mesh, about, scale, up) - energy(mesh, about, scale, down)) / (2 * d);
      ASSERT_NEAR(wanted, slope[row], 1e-6 * (1 + slope.cwiseAbs().maxCoeff())) << "case " << k;
    }
  }
}

} // namespace
} // namespace hopmesh::tests
