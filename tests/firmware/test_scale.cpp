// The search for the scale of a step of the incremental potential: with an array that is too coarse to move,
// with one that never moves, and where nothing pulls.
#include "tests/firmware/moving_mesh.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

/// A solver that counts how often it is asked. Its outputs are whole numbers of `place`, reached from below,
/// so that what is shorter than a place is not done; place = 0: nothing ever moves.
struct Coarse {
  double place = 0.25;
  int calls = 0;
  std::vector<double> largest = {}; ///< |V| at the end of each call

  static int relax(void* self, const hm_mesh* mesh, hm_network* network, double threshold,
                   std::uint32_t max_sweeps, hm_relaxation* result) {
    Coarse& coarse = *static_cast<Coarse*>(self);
    ++coarse.calls;
    const std::size_t neurons = hm_neuron_count(mesh);
    if (coarse.place > 0) relax_in_double(nullptr, mesh, network, threshold, max_sweeps, result);
    coarse.largest.push_back(0);
    for (std::size_t k = 0; k < neurons; ++k) {
      double& V = network->output[k];
      V = coarse.place > 0 ? std::trunc(V / coarse.place) * coarse.place : 0;
      coarse.largest.back() = std::max(coarse.largest.back(), std::abs(V));
    }
    result->sweeps = 1, result->converged = 1;
    return HM_OK;
  }
};

/// A weight on a spring of k = 2 alpha, straight below a pin; it falls with g.
scene::Mesh hanging(double alpha) {
  scene::Mesh mesh;
  mesh.position = {{0, 0, 0}, {0, 0, -1}};
  mesh.pinned = {true, false};
  mesh.springs = {{{0, 1}, alpha, 1}};
  return mesh;
}

hm_step_parameters falling(const hm_formulation& formulation, double g) {
  hm_step_parameters m{};
  m.formulation = &formulation, m.mass = 0.5, m.time_step = 0.1, m.friction = 1;
  m.force[2] = -g, m.threshold = 1e-12, m.max_sweeps = 2000, m.expansions = 1;
  return m;
}

/// A first step of that weight with that solver; the scale it came to.
double step_scale(Coarse& coarse, const hm_step_parameters& m, Pair& pair, Moving& moving) {
  const hm_solver solver{&coarse, &Coarse::relax, nullptr, nullptr};
  hm_step_result result;
  EXPECT_EQ(hm_step(&pair.firmware.mesh, &m, &solver, &moving.state, &result), HM_OK);
  EXPECT_EQ(result.relaxation.sweeps, static_cast<unsigned>(coarse.calls));
  return moving.state.scale;
}

double least_power_above(double x) {
  return std::exp2(std::ceil(std::log2(x)));
}

// A neuron that no neighbour holds goes exactly where its own weight says. C lies dt^2 g below, the
// spring pulls with k dt^2 g, and what holds the weight is k + m / dt^2; h = dt^2 / 2.
TEST(Scale, TheFirstGuessKnowsTheOwnWeight) {
  for (const double k : {1.0, 1e2, 1e4, 1e6}) {
    const double g = 3, dt = 0.1, m = 0.5, change = k * dt * dt * g / (k + m / dt / dt) / (dt * dt / 2);
    Pair pair(hanging(k / 2));
    Moving moving(pair);
    Coarse coarse{1e-9};
    EXPECT_EQ(step_scale(coarse, falling(hm_backward_euler, g), pair, moving), least_power_above(2 * change));
    EXPECT_EQ(coarse.calls, 1);
    reference::State state = reference::initial_state(pair.scene, reference::backward_euler);
    const reference::StepParameters same = reference_motion(falling(hm_backward_euler, g));
    EXPECT_EQ(reference::advance(pair.scene, same, {{3}, {4}, {5}}, state).scale, moving.state.scale);
  }
}

// With places of a half and more, the first guess, at which the answer lies between 1/4 and 1/2, is too
// coarse to move at all. The step is tried at a quarter of it, and moves.
TEST(Scale, ShrinksWhereNothingMoves) {
  for (const hm_formulation* formulation : {&hm_backward_euler, &hm_bdf2, &hm_static}) {
    Pair pair(hanging(50));
    Moving moving(pair);
    Coarse coarse{0.5};
    step_scale(coarse, falling(*formulation, 3), pair, moving);
    ASSERT_GE(coarse.calls, 2);
    EXPECT_EQ(coarse.largest[0], 0);
    EXPECT_GE(coarse.largest.back(), 0.5);
    EXPECT_NE(moving.acceleration[5], 0);
  }
}

// As often as it must: an acceleration of the step before that is 10^6 times too large says nothing of this
// one.
TEST(Scale, ShrinksAsOftenAsItMust) {
  Pair pair(hanging(50));
  Moving fresh(pair), spoilt(pair);
  Coarse coarse{0.125}, again{0.125};
  const double fitting = step_scale(coarse, falling(hm_backward_euler, 3), pair, fresh);
  spoilt.acceleration[5] = 1e6 * fitting;
  EXPECT_LE(step_scale(again, falling(hm_backward_euler, 3), pair, spoilt), 4 * fitting);
  EXPECT_GE(again.largest.back(), 0.125);
}

// An array that never moves ends the search: where an output of 1 is less than a last place of the positions.
TEST(Scale, EndsWhereNoForceIsLeftThatMatters) {
  Pair pair(hanging(50));
  Moving moving(pair);
  Coarse stuck{0};
  const double scale = step_scale(stuck, falling(hm_backward_euler, 3), pair, moving);
  EXPECT_GT(stuck.calls, 20);
  EXPECT_LT(stuck.calls, 40);
  EXPECT_GE(scale * 0.1 * 0.1 / 2, 0x1p-53);
  EXPECT_LT(scale * 0.1 * 0.1 / 2, 4 * 0x1p-52);
}

TEST(Scale, IsNotSearchedWhereNothingPulls) {
  Pair pair(hanging(50));
  Moving moving(pair);
  Coarse coarse;
  step_scale(coarse, falling(hm_backward_euler, 0), pair, moving);
  EXPECT_EQ(coarse.calls, 1);
  EXPECT_EQ(moving.position[5], -1);
}

} // namespace
} // namespace hopmesh::tests
