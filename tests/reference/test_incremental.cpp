// The incremental potential: its network against differences of its energy, its steps against a Newton solver
// that knows neither outputs nor scales, and against recurrences done by hand (docs/method/theory.md, section
// 4).
#include "tests/reference/plain_energy.h"
#include "tests/reference/random_inputs.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace reference;

struct Case {
  scene::Mesh mesh;
  StepParameters motion;
  State state;
};

StepParameters incremental_motion(Random& random, const Formulation& formulation) {
  StepParameters motion = random_motion(random);
  motion.formulation = &formulation;
  motion.mass = random.between(0.1, 2);
  motion.drag = random.chance(0.5) ? 0 : random.between(0.1, 5);
  return motion;
}

Case random_case(Random& random, int k) {
  Case c;
  const bool planar = k % 2 == 1;
  const double rest_factor[] = {1, 0, 3};
  c.mesh = random_mesh(random, 5 + random.below(4), planar, rest_factor[k % 3]);
  c.motion = incremental_motion(random, k % 4 < 2 ? backward_euler : bdf2);
  c.state = random_state(random, c.mesh);
  c.state.previous_position = c.state.position - c.motion.time_step * c.state.velocity;
  c.state.previous_velocity = 0.9 * c.state.velocity;
  return c;
}

// Phi of docs/method/theory.md, section 4, with loops.
Wide plain_phi(const Case& c, const Increment& about, double scale, const WideVector& V) {
  const Wide reach = Wide(about.h) * scale;
  Wide sum = 0;
  for (const scene::Spring& spring : c.mesh.springs)
    sum += plain_spring(spring, place(c.mesh, reach, about.predicted, V, spring.node[0]),
                        place(c.mesh, reach, about.predicted, V, spring.node[1]));
  for (const Wide& v : V) sum += Wide(about.inertia) / 2 * reach * v * reach * v;
  return sum;
}

bool free_row(const Case& c, Eigen::Index row) {
  return !c.mesh.pinned[row / components(c.mesh)];
}

TEST(ReferenceIncremental, TheNetworkHasTheSlopeOfTheEnergy) {
  Random random(41);
  for (int k = 0; k < 60; ++k) {
    const Case c = random_case(random, k);
    const Increment about = increment(c.mesh, c.motion, c.state);
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(8)) - 2);
    const Vector V0 = random_outputs(random, c.mesh);
    const Network net = network(c.mesh, about, scale, V0);
    const Vector slope = -(net.W * V0) - net.I;
    const WideVector V = widened(V0);
    EXPECT_NEAR(static_cast<double>(plain_phi(c, about, scale, V)), energy(c.mesh, about, scale, V0),
                1e-12 * energy(c.mesh, about, scale, V0));
    for (Eigen::Index row = 0; row < slope.size(); ++row) {
      if (!free_row(c, row)) continue;
      const Wide d = 1e-9;
      WideVector up = V, down = V;
      up[row] += d, down[row] -= d;
      const Wide wanted = (plain_phi(c, about, scale, up) - plain_phi(c, about, scale, down)) / (2 * d);
      ASSERT_NEAR(static_cast<double>(wanted), slope[row], 1e-11 * slope.cwiseAbs().maxCoeff())
          << "case " << k << " row " << row;
    }
  }
}

TEST(ReferenceIncremental, TheNetworkIsConvexEvenWhereSpringsAreCompressed) {
  Random random(42);
  for (int k = 0; k < 60; ++k) {
    const Case c = random_case(random, k);
    const Network net =
        network(c.mesh, increment(c.mesh, c.motion, c.state), 1, random_outputs(random, c.mesh));
    const Eigen::MatrixXd W(net.W);
    EXPECT_EQ(W, Eigen::MatrixXd(W.transpose()));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(W);
    EXPECT_LE(solver.eigenvalues().maxCoeff(), 1e-12 * W.cwiseAbs().maxCoeff()) << "case " << k;
  }
}

/// Newton's method on the positions themselves, dense, every derivative written out for it: the exact step.
class ExactStep {
 public:
  ExactStep(const scene::Mesh& mesh, const Increment& about) : mesh_(mesh), about_(about) {}

  Vector solve() {
    Vector x = about_.predicted;
    for (int k = 0; k < 200; ++k) {
      derive(x);
      if (gradient_.norm() < 1e-14 * scale_) break;
      const Eigen::VectorXd step = curvature_.ldlt().solve(-gradient_);
      const double now = value(x);
      double share = 1;
      while (share > 1e-6 && value(x + share * step) > now) share /= 2;
      x += share * step;
    }
    return x;
  }

 private:
  double value(const Vector& x) const {
    return about_.inertia / 2 * (x - about_.predicted).squaredNorm() + spring_energy(mesh_, x);
  }

  bool moves(Eigen::Index k) const { return !mesh_.pinned[k / 3] && !(mesh_.planar && k % 3 == 1); }

  void derive(const Vector& x) {
    gradient_ = about_.inertia * (x - about_.predicted);
    curvature_ = about_.inertia * Eigen::MatrixXd::Identity(x.size(), x.size());
    scale_ = gradient_.norm() + 1;
    for (const scene::Spring& s : mesh_.springs) add(s, x);
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      if (moves(k)) continue;
      gradient_[k] = 0;
      curvature_.row(k).setZero();
      curvature_.col(k).setZero();
      curvature_(k, k) = 1;
    }
  }

  void add(const scene::Spring& s, const Vector& x) {
    const Eigen::Index i = 3 * s.node[0], j = 3 * s.node[1];
    const Eigen::Vector3d u = x.segment<3>(i) - x.segment<3>(j), w = u.normalized();
    const double ratio = s.rest_length / u.norm();
    const Eigen::Vector3d f = 2 * s.weight * (1 - ratio) * u;
    const Eigen::Matrix3d K =
        2 * s.weight *
        ((1 - std::min(ratio, 1.0)) * Eigen::Matrix3d::Identity() + std::min(ratio, 1.0) * w * w.transpose());
    gradient_.segment<3>(i) += f, gradient_.segment<3>(j) -= f;
    curvature_.block<3, 3>(i, i) += K, curvature_.block<3, 3>(j, j) += K;
    curvature_.block<3, 3>(i, j) -= K, curvature_.block<3, 3>(j, i) -= K;
  }

  const scene::Mesh& mesh_;
  const Increment& about_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd curvature_;
  double scale_ = 1;
};

TEST(ReferenceIncremental, AStepRelaxedToTheEndIsTheExactImplicitStep) {
  Random random(43);
  for (int k = 0; k < 24; ++k) {
    Case c = random_case(random, k);
    c.motion.time_step = k % 3 == 0 ? 0.2 : 0.05;
    c.motion.threshold = 1e-15, c.motion.max_sweeps = 20000, c.motion.expansions = 60;
    const Vector wanted = ExactStep(c.mesh, increment(c.mesh, c.motion, c.state)).solve();
    const Order order = one_by_one(c.state.V.size());
    const Step step = advance(c.mesh, c.motion, order, c.state);
    EXPECT_LT((c.state.position - wanted).cwiseAbs().maxCoeff(), 1e-10) << "case " << k;
    EXPECT_GE(step.relaxation.V.cwiseAbs().maxCoeff(), 0.125);
    EXPECT_LE(step.relaxation.V.cwiseAbs().maxCoeff(), 0.75);
    int exponent;
    EXPECT_EQ(std::frexp(step.scale, &exponent), 0.5) << "no power of two: " << step.scale;
  }
}

/// A weight on a spring that hangs straight down and stays on its line, where the spring is linear.
struct Hanging {
  Hanging(const Formulation& formulation, double time_step) {
    mesh.position = {{0, 0, 0}, {0, 0, -1}};
    mesh.pinned = {true, false};
    mesh.springs = {{{0, 1}, 5, 1}}; // k = 2 alpha = 10
    motion.formulation = &formulation, motion.mass = 0.5, motion.drag = 0.3, motion.time_step = time_step;
    motion.friction = 1, motion.force = {0, 0, -2};
    motion.threshold = 1e-16, motion.max_sweeps = 4000, motion.expansions = 2;
    mesh.mass = motion.mass;
    state = initial_state(mesh, formulation);
  }
  void advance_once() { advance(mesh, motion, one_by_one(6), state); }
  double x() const { return state.position[5]; }
  double v() const { return state.velocity[5]; }

  scene::Mesh mesh;
  StepParameters motion{};
  State state;
};

// a = -(k/m) (z + 1) - c v - 2 with k/m = 20, c = 0.3.
TEST(ReferenceIncremental, BackwardEulerOfAWeightOnASpringByHand) {
  const double dt = 0.05;
  Hanging hanging(backward_euler, dt);
  double z = -1, v = 0;
  for (int k = 0; k < 100; ++k) {
    hanging.advance_once();
    // v' = v + dt (-20 (z + dt v' + 1) - 0.3 v' - 2)
    v = (v + dt * (-20 * (z + 1) - 2)) / (1 + 20 * dt * dt + 0.3 * dt);
    z += dt * v;
    ASSERT_NEAR(hanging.x(), z, 1e-12) << "step " << k;
    ASSERT_NEAR(hanging.v(), v, 1e-10) << "step " << k;
  }
}

TEST(ReferenceIncremental, Bdf2OfAWeightOnASpringByHand) {
  const double dt = 0.05;
  Hanging hanging(bdf2, dt);
  double z[2] = {-1, -1}, v[2] = {0, 0}; // now, before
  for (int k = 0; k < 100; ++k) {
    hanging.advance_once();
    const double tau = k == 0 ? dt : 2 * dt / 3;
    const double from_z = k == 0 ? z[0] : (4 * z[0] - z[1]) / 3,
                 from_v = k == 0 ? v[0] : (4 * v[0] - v[1]) / 3;
    const double next_v = (from_v + tau * (-20 * (from_z + 1) - 2)) / (1 + 20 * tau * tau + 0.3 * tau);
    const double next_z = from_z + tau * next_v;
    z[1] = z[0], v[1] = v[0], z[0] = next_z, v[0] = next_v;
    ASSERT_NEAR(hanging.x(), z[0], 1e-12) << "step " << k;
    ASSERT_NEAR(hanging.v(), v[0], 1e-10) << "step " << k;
  }
}

// The closed form: z = -1.1 + (0.1 cos wt + ...) e^-ct/2 about the rest at -1 - 2/20.
double closed_form(double t) {
  const double decay = 0.15, w = std::sqrt(20 - decay * decay);
  return -1.1 + std::exp(-decay * t) * 0.1 * (std::cos(w * t) + decay / w * std::sin(w * t));
}

TEST(ReferenceIncremental, HalvingTheTimeStepShowsTheOrder) {
  for (const auto& [formulation, order] : {std::pair(&backward_euler, 1.0), std::pair(&bdf2, 2.0)}) {
    double error[2];
    for (int fine = 0; fine < 2; ++fine) {
      const int steps = fine ? 400 : 200;
      Hanging hanging(*formulation, 1.0 / steps);
      for (int k = 0; k < steps; ++k) hanging.advance_once();
      error[fine] = std::abs(hanging.x() - closed_form(1));
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), order, 0.1);
  }
}

TEST(ReferenceIncremental, RestWithoutForceStays) {
  Hanging hanging(bdf2, 0.05);
  hanging.motion.force.setZero();
  for (int k = 0; k < 5; ++k) hanging.advance_once();
  EXPECT_EQ(hanging.x(), -1);
  EXPECT_EQ(hanging.v(), 0);
}

} // namespace
} // namespace hopmesh::tests
