// The linearly implicit step against a dense solve of the same step, and when its iteration ends.
#include "tests/rivals/rival_meshes.h"

#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace rivals;

constexpr double step_length = 0.03;

/// A spring's 3 x 3 stiffness from its definition, L/l at most 1, and its force on its first node.
struct Spring {
  Eigen::Matrix3d stiffness;
  Eigen::Vector3d force;
};
Spring spring_of(const scene::Spring& spring, const Eigen::Vector3d& span) {
  const double k = 2 * spring.weight, length = span.norm(), ratio = spring.rest_length / length;
  const Eigen::Matrix3d along = span * span.transpose() / (length * length);
  return {k * (std::min(ratio, 1.0) * along + (1 - std::min(ratio, 1.0)) * Eigen::Matrix3d::Identity()),
          k * (1 - ratio) * span};
}

/// The dense matrix of the step's inertia and stiffness about x, and the force there; both by component.
struct Dense {
  Eigen::MatrixXd matrix;
  Vector force;
};
Dense dense_about(const scene::Mesh& mesh, const Vector& x, double inertia) {
  const Eigen::Index n = mesh.nodes();
  Dense all{Eigen::MatrixXd::Identity(3 * n, 3 * n) * inertia, Vector::Zero(3 * n)};
  for (const scene::Spring& spring : mesh.springs) {
    const Eigen::Index a = spring.node[0], b = spring.node[1];
    Eigen::Vector3d span;
    for (Eigen::Index p = 0; p < 3; ++p) span[p] = x[p * n + b] - x[p * n + a];
    const Spring pull = spring_of(spring, span);
    for (Eigen::Index p = 0; p < 3; ++p) {
      all.force[p * n + a] += pull.force[p], all.force[p * n + b] -= pull.force[p];
      for (Eigen::Index q = 0; q < 3; ++q) {
        all.matrix(p * n + a, q * n + a) += pull.stiffness(p, q);
        all.matrix(p * n + b, q * n + b) += pull.stiffness(p, q);
        all.matrix(p * n + a, q * n + b) -= pull.stiffness(p, q);
        all.matrix(p * n + b, q * n + a) -= pull.stiffness(p, q);
      }
    }
  }
  return all;
}

/// Where the step linearised about `place` ends: of what moves, the solution of m/dt^2 (1 + c dt) (x - y) =
/// F(place) - K (x - place).
Vector dense_step(const scene::Mesh& mesh, const Physics& physics, const State& state, const Vector& place) {
  const double braked = physics.slowed(step_length),
               inertia = physics.mass() * braked / (step_length * step_length);
  const Vector y =
      state.position + step_length / braked * (state.velocity + step_length * physics.external());
  const Dense all = dense_about(mesh, place, inertia);
  std::vector<Eigen::Index> moves;
  for (Eigen::Index k = 0; k < y.size(); ++k)
    if (physics.inverse_mass()[k] != 0) moves.push_back(k);
  const Vector right = inertia * (y - place) + all.force;
  Vector x = place;
  x(moves) += all.matrix(moves, moves).llt().solve(Vector(right(moves)));
  return x;
}

/// Where the step would end with the acceleration of the step before; in the first, without springs.
Vector expected_place(const Physics& physics, const State& now, const State* before) {
  if (before) return now.position + step_length * (now.velocity + (now.velocity - before->velocity));
  return now.position +
         step_length / physics.slowed(step_length) * (now.velocity + step_length * physics.external());
}

/// Stretched, compressed and turned springs; every free coordinate with a speed of its own.
State disturbed(const Physics& physics) {
  State start = physics.initial_state();
  for (Eigen::Index k = 0; k < start.position.size(); ++k)
    if (physics.inverse_mass()[k] != 0) {
      start.position[k] += 0.03 * std::sin(3.0 * double(k * k % 997));
      start.velocity[k] = 0.4 * std::sin(2.0 * double(k * k % 991));
    }
  return start;
}

void expect_dense_steps(const scene::Mesh& mesh) {
  const Physics physics(mesh, banner_air);
  Options options;
  options.tolerance = 1e-14;
  const auto method = make_method("linearly_implicit", physics, step_length, options);
  method->start_from(disturbed(physics));
  State before;
  for (int k = 0; k < 5; ++k) {
    const State now = method->state();
    method->advance();
    const Vector x = dense_step(mesh, physics, now, expected_place(physics, now, k > 0 ? &before : nullptr));
    before = now;
    ASSERT_LT((method->state().position - x).lpNorm<Eigen::Infinity>(), 1e-11) << "step " << k;
    ASSERT_LT((method->state().velocity - (x - now.position) / step_length).lpNorm<Eigen::Infinity>(), 1e-9);
  }
}

TEST(LinearlyImplicit, IsTheDenseSolveOfTheStepLinearised) {
  expect_dense_steps(sheet(7, 50));
  expect_dense_steps(sheet(12, 5000));
}

TEST(LinearlyImplicit, LeavesAPlanarMeshInItsPlane) {
  scene::Mesh mesh = sheet(6, 50);
  mesh.planar = true;
  expect_dense_steps(mesh);
}

/// All implicit methods end a step by the tolerance that they are given: the wider, the fewer iterations and
/// the farther from the step solved.
TEST(ImplicitRivals, StopWhereTheyAreTold) {
  const scene::Mesh mesh = sheet(10, 50);
  const Physics physics(mesh, banner_air);
  for (const std::string name : {"backward_euler", "bdf2", "linearly_implicit", "projective_dynamics"}) {
    std::uint64_t iterations = ~0ull;
    double error = -1;
    Vector exact;
    for (const double tolerance : {1e-10, 1e-5, 1e-3}) {
      Options options;
      options.tolerance = tolerance;
      const auto method = make_method(name, physics, step_length, options);
      method->start_from(disturbed(physics));
      method->advance();
      if (exact.size() == 0) exact = method->positions();
      EXPECT_LT(method->counters().iterations, iterations) << name << ' ' << tolerance;
      EXPECT_GT(distance(method->positions(), exact), error) << name << ' ' << tolerance;
      EXPECT_LT(distance(method->positions(), exact), 30 * tolerance) << name;
      iterations = method->counters().iterations;
      error = distance(method->positions(), exact);
    }
  }
}

} // namespace
} // namespace hopmesh::tests
