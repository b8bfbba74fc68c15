// Descriptions as text: what is written reads back equal, to the last bit of every number.
#include "rtl_model/spec/presets.h"
#include "sim/input/shipped.h"
#include "tests/scene/scene_makers.h"

#include <cmath>
#include <random>

namespace hopmesh::tests {
namespace {

using namespace scene;

void expect_equal(const MeshSpec& a, const MeshSpec& b) {
  ASSERT_EQ(a.grid.has_value(), b.grid.has_value());
  if (a.grid) {
    EXPECT_EQ(a.grid->rows, b.grid->rows);
    EXPECT_EQ(a.grid->columns, b.grid->columns);
    EXPECT_EQ(a.grid->pitch, b.grid->pitch);
  }
  EXPECT_EQ(a.file, b.file);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.structural, b.structural);
  EXPECT_EQ(a.shear, b.shear);
  EXPECT_EQ(a.bend, b.bend);
  EXPECT_EQ(a.law, b.law);
  EXPECT_EQ(a.floor, b.floor);
  EXPECT_EQ(a.pinned, b.pinned);
  EXPECT_EQ(a.pin_band, b.pin_band);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.rest, b.rest);
  EXPECT_EQ(a.planar, b.planar);
  EXPECT_EQ(a.start.shuffle, b.start.shuffle);
  EXPECT_EQ(a.start.seed, b.start.seed);
  EXPECT_EQ(a.start.velocity, b.start.velocity);
  ASSERT_EQ(a.pin_ball.has_value(), b.pin_ball.has_value());
  if (!a.pin_ball) return;
  EXPECT_EQ(a.pin_ball->centre, b.pin_ball->centre);
  EXPECT_EQ(a.pin_ball->radius, b.pin_ball->radius);
}

void expect_equal(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  expect_equal(a.mesh, b.mesh);
  EXPECT_EQ(a.motion.formulation, b.motion.formulation);
  EXPECT_EQ(a.motion.time_step, b.motion.time_step);
  EXPECT_EQ(a.motion.steps, b.motion.steps);
  EXPECT_EQ(a.motion.friction, b.motion.friction);
  EXPECT_EQ(a.probe.gamma, b.probe.gamma);
  EXPECT_EQ(a.probe.beta, b.probe.beta);
  EXPECT_EQ(a.probe.acceleration_memory, b.probe.acceleration_memory);
  EXPECT_EQ(a.probe.energy_springs, b.probe.energy_springs);
  EXPECT_EQ(a.probe.force_on, b.probe.force_on);
  EXPECT_EQ(a.incremental.rule, b.incremental.rule);
  EXPECT_EQ(a.relax.threshold, b.relax.threshold);
  EXPECT_EQ(a.relax.max_sweeps, b.relax.max_sweeps);
  EXPECT_EQ(a.relax.expansions, b.relax.expansions);
  EXPECT_EQ(a.relax.stop, b.relax.stop);
  EXPECT_EQ(a.relax.share, b.relax.share);
  EXPECT_EQ(a.relax.momentum, b.relax.momentum);
  EXPECT_EQ(a.rival.tolerance, b.rival.tolerance);
  EXPECT_EQ(a.force.gravity, b.force.gravity);
  EXPECT_EQ(a.force.wind, b.force.wind);
  EXPECT_EQ(a.force.drag, b.force.drag);
}

void expect_equal(const spec::ArraySpec& a, const spec::ArraySpec& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.schedule, b.schedule);
  EXPECT_EQ(a.lanes, b.lanes);
  EXPECT_EQ(a.output, b.output);
  EXPECT_EQ(a.normaliser, b.normaliser);
  EXPECT_EQ(a.reciprocal_bits, b.reciprocal_bits);
  EXPECT_EQ(a.exact_accumulator, b.exact_accumulator);
  EXPECT_EQ(a.bus_bits, b.bus_bits);
  EXPECT_EQ(a.clock_mhz, b.clock_mhz);
  EXPECT_EQ(a.formats.weight, b.formats.weight);
  EXPECT_EQ(a.formats.bias, b.formats.bias);
  EXPECT_TRUE(a.exact_accumulator || a.formats.accumulator == b.formats.accumulator);
  EXPECT_EQ(a.formats.drive, b.formats.drive);
  EXPECT_EQ(a.formats.state, b.formats.state);
  EXPECT_EQ(a.formats.link, b.formats.link);
}

TEST(Text, ofEveryShippedSceneReadsBack) {
  for (const std::string& name : input::shipped_names(input::Shipped::scene)) {
    const Scene s = read_inputs(name, "", {}).scene;
    expect_equal(scene_of(scene_text(s)), s);
  }
}

TEST(Text, ofASceneWithEveryKeyReadsBack) {
  const Scene s = read_inputs(folder + "good/every_key.toml", "", {}).scene;
  expect_equal(scene_of(scene_text(s)), s);
}

TEST(Text, keepsEveryKeyOfAFileMesh) {
  const Scene s = scene_of("[mesh]\nfile = 'a \"b\" \\ c.obj'\nscale = 0.1\nup = \"x\"\npin_band = 0.3\n"
                           "springs = { structural = 0.7 }\npinned = [5, \"right\"]\n");
  expect_equal(scene_of(scene_text(s)), s);
}

TEST(Text, keepsEveryBitOfRandomNumbers) {
  constexpr unsigned seed = 20240607;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-14, 14);
  for (int k = 0; k < 200; ++k) {
    Scene s = grid_scene(2, 2, std::pow(10, exponent(random)));
    s.name = "random";
    s.probe.gamma = std::pow(10, exponent(random));
    s.relax.threshold = std::pow(10, exponent(random));
    s.force.wind = Vector3{-std::pow(10, exponent(random)), std::pow(10, exponent(random)), 0};
    expect_equal(scene_of(scene_text(s)), s);
  }
}

TEST(Text, keepsTheSignOfZero) {
  Scene s = grid_scene(2, 2);
  s.name = "zero";
  s.force.gravity = {-0.0, 0.0, 0.0};
  EXPECT_TRUE(std::signbit(scene_of(scene_text(s)).force.gravity[0]));
}

TEST(Text, ofArraysReadsBack) {
  std::vector<spec::ArraySpec> arrays = spec::presets();
  arrays.push_back(read_inputs("flag-400", folder + "good/every_array_key.toml", {}).array);
  for (const spec::ArraySpec& a : arrays) {
    const Folder temp;
    expect_equal(read_inputs("flag-400", temp.write("a.toml", input::array_text(a)), {}).array, a);
  }
}

} // namespace
} // namespace hopmesh::tests
