// The firmware's time step with a solver in double, against the reference's for twenty steps.
#include "tests/firmware/moving_mesh.h"

extern "C" {
#include "firmware/springs.h"
}

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

int refuse(void*, const hm_mesh*, hm_network*, double, std::uint32_t, hm_relaxation*) {
  return HM_ERROR_STOPPED;
}

hm_step_parameters random_parameters(Dice& dice) {
  hm_step_parameters m{};
  m.formulation = hm_formulations[dice.below(std::size(hm_formulations))];
  m.mass = 0.2 + dice.unit(), m.drag = dice.one_in(2) ? 0 : 3 * dice.unit();
  m.time_step = 0.05, m.friction = 0.99, m.gamma = dice.one_in(2) ? 40 : 4000,
  m.beta = dice.one_in(3) ? 0 : 1;
  m.acceleration_memory = dice.one_in(2);
  m.energy_of_all_springs = dice.one_in(2);
  m.force_on_acceleration = dice.one_in(2);
  m.force[0] = 0.1, m.force[1] = dice.unit() - 0.5, m.force[2] = -0.2;
  m.threshold = 1e-7, m.max_sweeps = 40;
  m.expansions = 1 + static_cast<std::uint32_t>(dice.below(2));
  return m;
}

reference::Order number_order(const Pair& pair) {
  reference::Order order;
  for (std::uint32_t c = 0; c < pair.firmware.mesh.cells; ++c)
    for (std::uint32_t p = 0; p < pair.firmware.mesh.components; ++p)
      order.push_back({static_cast<std::uint32_t>(pair.reference_index(c, p))});
  return order;
}

double largest_difference(const std::vector<double>& a, const reference::Vector& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    largest = std::max(largest, std::abs(a[k] - b[static_cast<Eigen::Index>(k)]));
  return largest;
}

/// The seed is the parameter.
class TwentySteps : public testing::TestWithParam<int> {};

TEST_P(TwentySteps, FollowTheReference) {
  Dice dice(GetParam());
  Pair pair(random_scene_mesh(dice, dice.one_in(2)));
  hm_step_parameters motion = random_parameters(dice);
  const hm_solver solver{nullptr, &relax_in_double, nullptr, nullptr};
  const reference::Order order = number_order(pair);
  reference::StepParameters same = reference_motion(motion);
  std::vector<double> node_force;
  if (motion.formulation != &hm_probe && dice.one_in(2)) {
    for (std::size_t k = 0; k < 3 * pair.scene.nodes(); ++k) node_force.push_back(dice.unit() - 0.5);
    motion.node_force = node_force.data();
    same.node_force = Eigen::Map<reference::Vector>(node_force.data(), Eigen::Index(node_force.size()));
  }
  reference::State expected = reference::initial_state(pair.scene, *same.formulation);
  Moving moving(pair);
  for (int step = 0; step < 20; ++step) {
    hm_step_result result;
    ASSERT_EQ(hm_step(&pair.firmware.mesh, &motion, &solver, &moving.state, &result), HM_OK);
    const reference::Step taken = reference::advance(pair.scene, same, order, expected);
    const double scale = 1 + expected.acceleration.cwiseAbs().maxCoeff();
    ASSERT_LT(largest_difference(moving.predicted, taken.predicted), 1e-9) << "step " << step;
    ASSERT_LT(largest_difference(moving.position, expected.position), 1e-9) << "step " << step;
    ASSERT_LT(largest_difference(moving.velocity, expected.velocity), 1e-9 * scale) << "step " << step;
    ASSERT_LT(largest_difference(moving.acceleration, expected.acceleration), 1e-9 * scale)
        << "step " << step;
    ASSERT_EQ(moving.state.step, expected.step);
    if (motion.formulation != &hm_probe && taken.scale > 1e-12) { // below, what is left to do is rounding
      ASSERT_EQ(moving.state.scale, taken.scale) << "step " << step;
    }
    const double energy = reference::spring_energy(pair.scene, expected.position);
    ASSERT_NEAR(hm_spring_energy(&pair.firmware.mesh, moving.position.data()), energy, 1e-9 * (1 + energy))
        << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(RandomMeshes, TwentySteps, testing::Range(1, 41));

TEST(Formulations, AreTheReferencesByName) {
  ASSERT_EQ(std::size(hm_formulations), std::size(reference::formulations));
  for (std::size_t k = 0; k < std::size(hm_formulations); ++k) {
    EXPECT_EQ(hm_formulations[k]->name, reference::formulations[k]->name);
    EXPECT_EQ(hm_formulations[k]->looks_back != 0, reference::formulations[k]->looks_back);
  }
}

/// A formulation that is none of ours: every node falls by its bias, and what hm_step called is kept in
/// order.
struct Falling {
  static std::string& calls() {
    static std::string text;
    return text;
  }
  static void begin(hm_step_work* work) {
    calls() += "begin ";
    work->h = 2;
  }
  static void build(const hm_step_work* work) {
    calls() += "build ";
    work->state->network.bias[0] = 3;
  }
  static void weigh(const hm_step_work*) { calls() += "weigh "; }
  static void next(const hm_step_work* work, std::uint32_t, hm_coordinate* next) {
    for (std::uint32_t p = 0; p < work->mesh->components; ++p)
      next[p] = {work->state->position[p] - work->h * work->state->network.bias[0], 7, 8};
  }
  static void finish(const hm_step_work* work) {
    calls() += "finish at " + std::to_string(static_cast<int>(work->state->position[2]));
  }
  static int relax(void*, const hm_mesh*, hm_network*, double, std::uint32_t, hm_relaxation* result) {
    calls() += "relax ";
    *result = {5, 1, 100};
    return HM_OK;
  }
};

TEST(Integrator, WalksAFormulationsFunctionsInOrder) {
  scene::Mesh one;
  one.position = {{0, 0, 10}}, one.pinned = {false};
  Pair pair(one);
  Moving moving(pair);
  moving.velocity = {1, 2, 3};
  Falling::calls().clear();
  const hm_formulation falling{"falling",       1,       &Falling::begin, &Falling::build,
                               &hm_expand,      nullptr, &Falling::weigh, &Falling::next,
                               &Falling::finish};
  hm_step_parameters parameters{};
  parameters.formulation = &falling, parameters.expansions = 2;
  const hm_solver solver{nullptr, &Falling::relax, nullptr, nullptr};
  hm_step_result result;
  ASSERT_EQ(hm_step(&pair.firmware.mesh, &parameters, &solver, &moving.state, &result), HM_OK);
  EXPECT_EQ(Falling::calls(), "begin build relax build relax weigh finish at 4");
  EXPECT_EQ(result.relaxation.sweeps, 10u);
  EXPECT_EQ(moving.velocity, std::vector<double>({7, 7, 7}));
  EXPECT_EQ(moving.acceleration, std::vector<double>({8, 8, 8}));
  EXPECT_EQ(moving.previous_position, std::vector<double>({0, 0, 10})); // it looks back
  EXPECT_EQ(moving.previous_velocity, std::vector<double>({1, 2, 3}));
  EXPECT_EQ(moving.state.step, 1u);
}

/// No step was done: all that the next one starts from is as it was.
void expect_untouched(const Moving& now, const Moving& before) {
  EXPECT_EQ(now.position, before.position);
  EXPECT_EQ(now.velocity, before.velocity);
  EXPECT_EQ(now.acceleration, before.acceleration);
  EXPECT_EQ(now.previous_position, before.previous_position);
  EXPECT_EQ(now.previous_velocity, before.previous_velocity);
  EXPECT_EQ(now.state.step, 0u);
}

TEST(Integrator, ASolversErrorLeavesTheMotionAlone) {
  Dice dice(7);
  Pair pair(random_scene_mesh(dice, false));
  const hm_step_parameters motion = random_parameters(dice);
  Moving moving(pair);
  for (double& v : moving.velocity) v = dice.unit();
  const Moving before = moving;
  const hm_solver solver{nullptr, &refuse, nullptr, nullptr};
  hm_step_result result;
  EXPECT_EQ(hm_step(&pair.firmware.mesh, &motion, &solver, &moving.state, &result), HM_ERROR_STOPPED);
  expect_untouched(moving, before);
}

/// Nothing of the state may have moved when a node would get no finite place or velocity, and it is named.
TEST(Integrator, ALostNodeIsToldBeforeAnyMoves) {
  Dice dice(8);
  Pair pair(random_scene_mesh(dice, false));
  const hm_mesh& mesh = pair.firmware.mesh;
  const hm_step_parameters motion = random_parameters(dice);
  const hm_solver solver{nullptr, &relax_in_double, nullptr, nullptr};
  for (std::uint32_t cell : {0u, mesh.cells / 2, mesh.cells - 1}) {
    Moving moving(pair);
    const std::uint32_t node = mesh.node_of_cell[cell];
    hm_step_parameters wild = motion;
    wild.formulation = &hm_probe;
    wild.gamma = 0; // nobody else is pushed
    wild.acceleration_memory = 0;
    wild.friction = 1e308;
    moving.velocity[3 * node] = 1e10;
    const Moving before = moving;
    hm_step_result result;
    ASSERT_EQ(hm_step(&mesh, &wild, &solver, &moving.state, &result), HM_ERROR_LOST);
    EXPECT_EQ(result.lost_node, node);
    expect_untouched(moving, before);
  }
}

TEST(Integrator, AnImplicitStepThatIsLostChangesNothing) {
  Dice dice(9);
  Pair pair(random_scene_mesh(dice, false));
  for (const hm_formulation* formulation : {&hm_backward_euler, &hm_bdf2}) {
    Moving moving(pair);
    hm_step_parameters wild = random_parameters(dice);
    wild.formulation = formulation;
    wild.friction = 1e308;
    moving.velocity[3 * pair.firmware.mesh.node_of_cell[0]] = 1e10;
    const Moving before = moving;
    const hm_solver solver{nullptr, &relax_in_double, nullptr, nullptr};
    hm_step_result result;
    ASSERT_EQ(hm_step(&pair.firmware.mesh, &wild, &solver, &moving.state, &result), HM_ERROR_LOST);
    expect_untouched(moving, before);
  }
}

} // namespace
} // namespace hopmesh::tests
