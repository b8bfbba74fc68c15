// Each integrator against its own recurrence on one spring, done by hand, to round-off.
#include "tests/rivals/rival_meshes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace rivals;

constexpr double dt = 0.05, c = 0.3;

double pull(double z) {
  return -20 * (z + 1) - 2;
}

struct Point {
  double z = -1, v = 0;
};

/// `next`: the recurrence, from the point and the one before it (in the first step the same).
template <class Next> void expect_recurrence(const std::string& name, const Options& options, Next next) {
  const scene::Mesh mesh = hanging_weight();
  const Physics physics(mesh, falling);
  const auto method = make_method(name, physics, dt, options);
  Point now, before;
  for (int k = 0; k < 200; ++k) {
    method->advance();
    const Point after = next(now, before, k);
    before = now, now = after;
    ASSERT_NEAR(method->positions()[5], now.z, 1e-12) << name << " step " << k;
    ASSERT_NEAR(method->velocities()[5], now.v, 1e-11) << name << " step " << k;
    ASSERT_EQ(method->positions()[3], 0);
  }
  EXPECT_DOUBLE_EQ(method->time(), 200 * dt);
}

TEST(RivalsRecurrence, SymplecticEuler) {
  expect_recurrence("symplectic_euler", {}, [](Point p, Point, int) {
    p.v = (1 - c * dt) * p.v + dt * pull(p.z);
    p.z += dt * p.v;
    return p;
  });
}

TEST(RivalsRecurrence, VelocityVerletWithOneForcePassAStep) {
  expect_recurrence("velocity_verlet", {}, [](Point p, Point, int) {
    const double half = p.v + dt / 2 * (pull(p.z) - c * p.v);
    p.z += dt * half;
    p.v = (half + dt / 2 * pull(p.z)) / (1 + c * dt / 2);
    return p;
  });
  const scene::Mesh mesh = hanging_weight();
  const Physics physics(mesh, falling);
  const auto method = make_method("velocity_verlet", physics, dt);
  for (int k = 0; k < 100; ++k) method->advance();
  EXPECT_EQ(method->counters().force_passes, 101u);
}

TEST(RivalsRecurrence, RungeKutta) {
  const auto slope = [](Point p) { return Point{p.v, pull(p.z) - c * p.v}; };
  expect_recurrence("rk4", {}, [&](Point p, Point, int) {
    const auto ahead = [&](double h, Point k) { return Point{p.z + h * k.z, p.v + h * k.v}; };
    const Point a = slope(p), b = slope(ahead(dt / 2, a)), d = slope(ahead(dt / 2, b)),
                e = slope(ahead(dt, d));
    return Point{p.z + dt / 6 * (a.z + 2 * b.z + 2 * d.z + e.z),
                 p.v + dt / 6 * (a.v + 2 * b.v + 2 * d.v + e.v)};
  });
}

// z' = z + b v', v' = v + b (pull(z') - c v'): solved for v'.
Point implicit(double z, double v, double b) {
  const double next = (v + b * pull(z)) / (1 + 20 * b * b + c * b);
  return {z + b * next, next};
}

TEST(RivalsRecurrence, BackwardEuler) {
  expect_recurrence("backward_euler", {}, [](Point p, Point, int) { return implicit(p.z, p.v, dt); });
}

TEST(RivalsRecurrence, Bdf2) {
  expect_recurrence("bdf2", {}, [](Point p, Point before, int k) {
    if (k == 0) return implicit(p.z, p.v, dt);
    return implicit((4 * p.z - before.z) / 3, (4 * p.v - before.v) / 3, 2 * dt / 3);
  });
}

// Along its axis a spring is linear: the linearised step is the step itself.
TEST(RivalsRecurrence, LinearlyImplicit) {
  expect_recurrence("linearly_implicit", {}, [](Point p, Point, int) { return implicit(p.z, p.v, dt); });
}

// A single constraint is met exactly by one sweep: XPBD is backward Euler here, of each substep.
TEST(RivalsRecurrence, Xpbd) {
  Options options;
  options.substeps = 4;
  expect_recurrence("xpbd", options, [](Point p, Point, int) {
    for (int k = 0; k < 4; ++k) p = implicit(p.z, p.v, dt / 4);
    return p;
  });
}

// Along its axis a spring's projection is exact: one iteration is the whole solve.
TEST(RivalsRecurrence, ProjectiveDynamics) {
  expect_recurrence("projective_dynamics", {}, [](Point p, Point, int) { return implicit(p.z, p.v, dt); });
}

TEST(RivalsRecurrence, AFreeNetKeepsItsMomentum) {
  const scene::Mesh mesh = sheet(6, 30, false);
  const Physics physics(mesh, {{0, 0, -9.81}, 0});
  for (const std::string& name : names()) {
    State start = physics.initial_state();
    for (Eigen::Index k = 0; k < start.velocity.size(); ++k)
      start.velocity[k] = 0.3 * std::sin(3.0 * double(k));
    Options options;
    options.tolerance = 1e-13; // an iteration that ends early leaves momentum behind
    const auto method = make_method(name, physics, 0.002, options);
    method->start_from(start);
    for (int k = 0; k < 100; ++k) method->advance();
    for (Eigen::Index p = 0; p < 3; ++p) {
      const auto sum = [&](const Vector& v) { return v.segment(p * 36, 36).sum() / 36; };
      const double wanted = sum(start.velocity) - (p == 2 ? 9.81 * 0.2 : 0);
      EXPECT_NEAR(sum(method->state().velocity), wanted, 1e-9) << name;
    }
  }
}

TEST(RivalsRecurrence, GoingOnFromAStateIsGoingOn) {
  const scene::Mesh mesh = sheet(5, 30);
  const Physics physics(mesh, banner_air);
  for (const std::string& name : names()) {
    const auto whole = make_method(name, physics, 0.004), half = make_method(name, physics, 0.004);
    for (int k = 0; k < 7; ++k) whole->advance();
    half->go_on_from(whole->state(), whole->before());
    for (int k = 0; k < 7; ++k) whole->advance(), half->advance();
    EXPECT_EQ(whole->positions(), half->positions()) << name;
    EXPECT_EQ(whole->velocities(), half->velocities()) << name;
  }
}

} // namespace
} // namespace hopmesh::tests
