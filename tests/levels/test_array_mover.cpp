// Firmware, driver, bus and a software array beside the double reference.
#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/presets.h"
#include "sim/levels/array_mover.h"
#include "sim/levels/bus_array.h"
#include "sim/levels/reference_mover.h"
#include "tests/support/complaint.h"
#include "tests/support/small_scenes.h"
#include "tests/support/soft_array.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using levels::StepRow;
using ::testing::HasSubstr;

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::fabs(a[k] - b[k]));
  return largest;
}

/// A scene on a software array.
struct Rig {
  explicit Rig(const scene::Scene& s, const spec::ArraySpec& a = fine_array(), bool check = true)
      : mesh(s), port(a, mesh.topology()), motion(s, mesh, a, port, check) {}
  levels::BuiltMesh mesh;
  SoftArray port;
  levels::ArrayMover motion;
};

TEST(ArrayMover, FollowsTheReferenceAsFarAsTheFormatsReach) {
  for (bool planar : {false, true}) {
    scene::Scene scene = grid_scene(3, 3);
    scene.mesh.planar = planar;
    if (planar) scene.force.wind = scene::Vector3{0.3, 0, 0};
    Rig rig(scene);
    levels::ReferenceMover reference(scene, rig.mesh, fine_array());
    for (int k = 0; k < 4; ++k) {
      const StepRow a = rig.motion.advance(), b = reference.advance();
      EXPECT_EQ(a.sweeps, b.sweeps);
      EXPECT_EQ(a.converged, b.converged);
      // A drive of 24 fraction bits sees no slope below 6e-8; the flattest direction is some 1e4 times
      // flatter than N.
      EXPECT_LT(a.error->rounding, 2e-3);
      EXPECT_LT(a.error->rms_output, a.error->largest_output);
      EXPECT_LE(a.error->rms_output, 1.0000001 * (a.error->rounding + a.error->stopping))
          << "the two are its parts";
      EXPECT_GE(a.error->energy_gap, -1e-13);
      EXPECT_LT(a.error->network, 1e-13);
      EXPECT_LT(largest_difference(rig.motion.positions(), reference.positions()), 1e-6);
      EXPECT_NEAR(a.energy, b.energy, 1e-6);
    }
  }
}

TEST(ArrayMover, ACoarseArrayIsFurtherOff) {
  spec::ArraySpec byte = *spec::preset("byte");
  Rig fine(grid_scene(3, 3)), coarse(grid_scene(3, 3), byte);
  EXPECT_GT(coarse.motion.advance().error->rounding, 100 * fine.motion.advance().error->rounding);
}

TEST(ArrayMover, RowsTellStepTimeCyclesAndBus) {
  Rig rig(grid_scene(2, 2));
  for (std::uint64_t k = 0; k < 3; ++k) {
    const StepRow row = rig.motion.advance();
    EXPECT_EQ(row.step, k);
    EXPECT_DOUBLE_EQ(row.time, 0.05 * static_cast<double>(k + 1));
    const auto phases = spec::phases_of(rig.mesh.topology(), fine_array().schedule);
    EXPECT_EQ(row.cycles, spec::cycle_model(fine_array(), rig.mesh.topology(), phases).run(row.sweeps));
    EXPECT_GT(row.bus_cycles, rig.mesh.topology().weight_words());
    EXPECT_EQ(row.clipped, 0u);
  }
  EXPECT_EQ(rig.port.begun, (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(rig.port.ended, rig.port.begun);
}

// Sweeps that end too early leave much, and the host need not ask the reference to see it.
TEST(ArrayMover, TheHostSeesWhatAStepLeaves) {
  scene::Scene scene = grid_scene(6, 6);
  scene.motion.formulation = scene::Formulation::incremental;
  for (const std::int64_t sweeps : {2, 2000}) {
    scene.relax.max_sweeps = sweeps;
    scene.relax.threshold = 1e-7;
    Rig rig(scene);
    for (int k = 0; k < 17; ++k) {
      const StepRow row = rig.motion.advance();
      ASSERT_TRUE(row.fall_left);
      ASSERT_EQ(row.fall_seen.has_value(), k == 0 || k == 8 || k == 16) << k;
      if (!row.fall_seen) continue;
      EXPECT_LE(*row.fall_seen, *row.fall_left + 1e-9);
      if (*row.fall_left > 0.15) {
        EXPECT_GT(*row.fall_seen, 0.1);
      }
      if (sweeps == 2000) {
        EXPECT_LT(*row.fall_left, 0.01);
      }
    }
  }
}

TEST(ArrayMover, WithoutCheckTheMotionIsTheSame) {
  Rig with(grid_scene(3, 3)), without(grid_scene(3, 3), fine_array(), false);
  for (int k = 0; k < 3; ++k) {
    const StepRow a = with.motion.advance(), b = without.motion.advance();
    EXPECT_TRUE(a.error);
    EXPECT_FALSE(b.error);
    EXPECT_EQ(a.hash, b.hash);
  }
}

TEST(ArrayMover, RawOutputsAreWhatTheArrayHolds) {
  Rig rig(grid_scene(2, 3));
  rig.motion.advance();
  const auto rest = rig.motion.rest_raw();
  EXPECT_EQ(rest, levels::BusArray(rig.port.bus(), rig.mesh.topology()).outputs());
  EXPECT_EQ(rig.motion.outputs_raw(), rig.mesh.by_node(rest));
}

/// An array of version 1 is refused by name, before anything is asked that it might not have.
TEST(ArrayMover, RefusesAnArrayOfVersionOne) {
  Rig rig(grid_scene(2, 2));
  rig.port.tell(HM_REG_VERSION, 0x00010001);
  const auto refusal = [&] { return complaint<std::runtime_error>([&] { rig.motion.advance(); }); };
  EXPECT_EQ(refusal(), "the array's registers are of version 1.1; this program knows version 2.1");
  rig.port.tell(HM_REG_ID, 7);
  EXPECT_EQ(refusal(), "there is no Hopmesh array behind the bus");
  rig.port.tell(HM_REG_ID, HM_ID_VALUE);
  rig.port.tell(HM_REG_VERSION, HM_VERSION_VALUE + 1);
  EXPECT_EQ(refusal(), "");
}

TEST(BusArray, TellsWhatTheRegistersHold) {
  Rig rig(grid_scene(2, 3));
  const levels::BusArray array(rig.port.bus(), rig.mesh.topology());
  rig.motion.advance();
  const std::uint64_t before = array.bus_cycles();
  const spec::Relaxation run = array.run(3, 7);
  EXPECT_TRUE(array.last_run() == run);
  EXPECT_EQ(array.threshold(), 3u);
  EXPECT_EQ(array.max_sweeps(), 7u);
  EXPECT_EQ(array.capabilities().front(), rig.mesh.cells());
  EXPECT_GT(array.bus_cycles(), before);
}

TEST(ArrayMover, RangesCoverWhatPassedTheBusAndWhatThePortSaw) {
  Rig rig(grid_scene(2, 3));
  rig.motion.advance();
  const auto ranges = rig.motion.ranges();
  ASSERT_EQ(ranges.size(), 4u);
  EXPECT_EQ(ranges[0].signal, "weight");
  EXPECT_LT(ranges[0].least, 0);
  EXPECT_LE(ranges[0].largest, fine_array().formats.weight.max_raw());
  EXPECT_EQ(ranges[2].signal, "state");
  EXPECT_LE(ranges[2].largest, fine_array().formats.state.one_raw());
  EXPECT_EQ(ranges[3].signal, "drive");
  EXPECT_EQ(ranges[3].largest, 4);
}

TEST(ArrayMover, AStoppedStepDidNotHappen) {
  Rig rig(grid_scene(2, 3));
  rig.motion.advance();
  const auto before = rig.motion.positions();
  rig.port.stop = true;
  EXPECT_THROW(rig.motion.advance(), levels::Stopped);
  EXPECT_EQ(rig.motion.positions(), before);
}

TEST(ArrayMover, ABrokenBusIsTold) {
  Rig rig(grid_scene(2, 3));
  rig.port.refuse = true;
  EXPECT_THAT(complaint<std::runtime_error>([&] { rig.motion.advance(); }),
              HasSubstr("the bus refused a transfer"));
}

TEST(ArrayMover, AnArrayBuiltForAnotherMeshIsTold) {
  const scene::Scene scene = grid_scene(2, 3);
  const levels::BuiltMesh mesh(scene), other(grid_scene(3, 3));
  SoftArray port(fine_array(), other.topology());
  levels::ArrayMover motion(scene, mesh, fine_array(), port, false);
  EXPECT_THROW(motion.advance(), std::runtime_error);
}

TEST(ArrayMover, NumbersBeyondDoubleDivergeAndTheLastGoodStateStays) {
  scene::Scene scene = grid_scene(1, 2);
  scene.force.gravity = {0, 0, -1e15};
  scene.motion.time_step = 1e15;
  Rig rig(scene, fine_array(), false);
  std::vector<double> before;
  const auto until_it_diverges = [&] {
    for (int k = 0; k < 100; ++k) {
      before = rig.motion.positions();
      rig.motion.advance();
    }
  };
  EXPECT_THROW(until_it_diverges(), levels::LostMotion);
  EXPECT_EQ(rig.motion.positions(), before);
  for (double x : before) EXPECT_TRUE(std::isfinite(x));
}

TEST(ArrayMover, TakesEveryKeyOfTheMotion) {
  scene::Scene s;
  s.motion.time_step = 0.1, s.motion.friction = 0.5;
  s.probe = {7, 8, 0.25, scene::EnergySprings::all, scene::ForceOn::acceleration};
  s.relax = {1e-3, 77, 3};
  s.force.gravity = {1, 2, 3}, s.force.wind = scene::Vector3{10, 20, 30};
  const hm_step_parameters m = levels::step_parameters(s);
  EXPECT_EQ(
      std::vector<double>({m.time_step, m.friction, m.gamma, m.beta, m.acceleration_memory, m.threshold}),
      std::vector<double>({0.1, 0.5, 7, 8, 0.25, 1e-3}));
  EXPECT_EQ(std::vector<double>(m.force, m.force + 3), std::vector<double>({11, 22, 33}));
  EXPECT_TRUE(m.energy_of_all_springs && m.force_on_acceleration);
  EXPECT_EQ(m.max_sweeps, 77u);
  EXPECT_EQ(m.expansions, 3u);
}

} // namespace
} // namespace hopmesh::tests
