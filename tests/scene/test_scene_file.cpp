// Scene files: every key arrives, what is left out has its default, names and paths are found.
#include "sim/input/shipped.h"
#include "tests/scene/scene_makers.h"
#include "tests/support/complaint.h"

#include "place.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

using ::testing::ElementsAre;

TEST(SceneFile, readsEveryKey) {
  const Scene s = read_inputs(folder + "good/every_key.toml", "", {}).scene;
  EXPECT_EQ(s.name, "every \"key\"= ✓");
  EXPECT_EQ(s.source, folder + "good/every_key.toml");
  EXPECT_EQ(s.mesh.grid->rows, 4);
  EXPECT_EQ(s.mesh.grid->columns, 5);
  EXPECT_EQ(s.mesh.grid->pitch, 0.1);
  EXPECT_FALSE(s.mesh.file);
  EXPECT_EQ(s.mesh.structural, 2);
  EXPECT_EQ(s.mesh.shear, 0.25);
  EXPECT_EQ(s.mesh.bend, 0.125);
  EXPECT_EQ(s.mesh.law, SpringLaw::tension);
  EXPECT_EQ(s.mesh.floor, 0.001);
  EXPECT_THAT(s.mesh.pinned, ElementsAre(Pin("left"), Pin(std::int64_t{7}), Pin("corners")));
  EXPECT_EQ(s.mesh.mass, 0.5);
  EXPECT_EQ(s.mesh.rest, 0.0);
  EXPECT_TRUE(s.mesh.planar);
  EXPECT_EQ(s.mesh.start.shuffle, 0.03);
  EXPECT_EQ(s.mesh.start.seed, 9);
  EXPECT_THAT(s.mesh.start.velocity, ElementsAre(0.25, 0, -0.5));
  ASSERT_TRUE(s.mesh.pin_ball);
  EXPECT_THAT(s.mesh.pin_ball->centre, ElementsAre(0.1, 0.2, -0.3));
  EXPECT_EQ(s.mesh.pin_ball->radius, 0.4);
}

TEST(SceneFile, readsEveryKeyOfTheMotion) {
  const Scene s = read_inputs(folder + "good/every_key.toml", "", {}).scene;
  EXPECT_EQ(s.motion.formulation, Formulation::incremental);
  EXPECT_EQ(s.motion.time_step, 0.01);
  EXPECT_EQ(s.motion.steps, 7);
  EXPECT_EQ(s.motion.friction, 0.9);
  EXPECT_EQ(s.probe.gamma, 12345.678901234567);
  EXPECT_EQ(s.probe.beta, 0.75);
  EXPECT_EQ(s.probe.acceleration_memory, 0.5);
  EXPECT_EQ(s.probe.energy_springs, EnergySprings::all);
  EXPECT_EQ(s.probe.force_on, ForceOn::acceleration);
  EXPECT_EQ(s.incremental.rule, Rule::bdf2);
  EXPECT_EQ(s.relax.threshold, 3e-7);
  EXPECT_EQ(s.relax.max_sweeps, 12);
  EXPECT_EQ(s.relax.expansions, 3);
  EXPECT_EQ(s.relax.stop, Stop::sum);
  EXPECT_EQ(s.relax.share, 0.001);
  EXPECT_THAT(s.relax.momentum, ElementsAre(0, 0.25, 1));
  EXPECT_EQ(s.rival.tolerance, 2e-5);
  EXPECT_THAT(s.force.gravity, ElementsAre(0, 0, -9.81));
  EXPECT_THAT(*s.force.wind, ElementsAre(1e-3, 0.3333333333333333, 5));
  EXPECT_EQ(s.force.drag, 0.625);
}

TEST(SceneFile, fillsDefaultsIn) {
  const Scene s = scene_of("[mesh]\ngrid = {}\n");
  EXPECT_EQ(s.name, "scene"); // the file's stem
  EXPECT_EQ(s.mesh.grid->rows, 20);
  EXPECT_EQ(s.mesh.grid->columns, 20);
  EXPECT_EQ(s.mesh.grid->pitch, 1.0);
  EXPECT_EQ(s.mesh.shear, 1.0);
  EXPECT_EQ(s.mesh.bend, 0.0);
  EXPECT_TRUE(s.mesh.pinned.empty());
  EXPECT_FALSE(s.mesh.rest);
  EXPECT_EQ(s.mesh.start.shuffle, 0.0);
  EXPECT_EQ(s.motion.steps, 400);
  EXPECT_EQ(s.probe.gamma, 4000.0);
  EXPECT_EQ(s.relax.max_sweeps, 300);
  EXPECT_EQ(s.relax.stop, Stop::change);
  EXPECT_TRUE(s.relax.momentum.empty());
  EXPECT_FALSE(s.force.wind);
  EXPECT_EQ(s.motion.formulation, Formulation::probe);
  EXPECT_EQ(s.incremental.rule, Rule::backward_euler);
  EXPECT_EQ(s.force.drag, 0.0);
}

TEST(SceneFile, takesIntegersWhereRealsAreMeant) {
  const Scene s =
      scene_of("[mesh]\ngrid = { pitch = 2 }\nmass = 3\nrest = 1\n[force]\ngravity = [0, 0, -1]\n");
  EXPECT_EQ(s.mesh.grid->pitch, 2.0);
  EXPECT_EQ(s.mesh.mass, 3.0);
  EXPECT_EQ(s.mesh.rest, 1.0);
  EXPECT_EQ(s.force.gravity[2], -1.0);
}

TEST(SceneFile, takesTheEndsOfEveryRange) {
  const Scene s = scene_of("[mesh]\ngrid = { rows = 1, columns = 2 }\nrest = 0\n"
                           "[motion]\nsteps = 1\nfriction = 0\n[probe]\ngamma = 0\nbeta = 0\n"
                           "[relax]\nthreshold = 0\nmax_sweeps = 1\nexpansions = 1\n");
  EXPECT_EQ(s.motion.friction, 0);
  EXPECT_EQ(s.probe.gamma, 0);
  EXPECT_EQ(s.relax.threshold, 0);
}

TEST(SceneFile, aListOfMomentumFitsTheTableOfItsArray) {
  const auto read = [](const std::string& list, const std::string& entries) {
    return complaint([&] {
      read_inputs("flag-400", "descent-momentum",
                  {"relax.momentum=" + list, "array.momentum_entries=" + entries});
    });
  };
  EXPECT_EQ(read("[0.5, 0.5]", "2"), "");
  EXPECT_EQ(read("\"fista\"", "1"), "");
  EXPECT_EQ(read("[0.5, 0.5]", "1"),
            "--set: relax.momentum: found 2 numbers, expected at most the 1 of array.momentum_entries");
}

TEST(SceneFile, pinsComeAloneOrInAList) {
  EXPECT_THAT(scene_of("[mesh]\ngrid = {}\npinned = \"top\"\n").mesh.pinned, ElementsAre(Pin("top")));
  EXPECT_THAT(scene_of("[mesh]\ngrid = {}\npinned = 3\n").mesh.pinned, ElementsAre(Pin(std::int64_t{3})));
  EXPECT_TRUE(scene_of("[mesh]\ngrid = {}\npinned = []\n").mesh.pinned.empty());
  EXPECT_FALSE(scene_of("[mesh]\ngrid = {}\nrest = \"natural\"\n").mesh.rest);
}

TEST(SceneFile, findsTheMeshBesideTheScene) {
  const Scene s = read_inputs(folder + "good/windows.toml", "", {}).scene;
  EXPECT_EQ(s.mesh.file, folder + "good/windows.obj");
  const Folder temp;
  EXPECT_EQ(read_inputs(temp.write("a.toml", "[mesh]\nfile = \"../x/./y.obj\"\n"), "", {}).scene.mesh.file,
            std::filesystem::path((temp / "../x/y.obj")).lexically_normal());
  EXPECT_EQ(scene_of("[mesh]\nfile = \"/x.obj\"\n").mesh.file, "/x.obj");
}

TEST(SceneFile, fileMeshesHaveNoShearAndBendByDefault) {
  const Scene s = scene_of("[mesh]\nfile = \"x.obj\"\nsprings = { structural = 2.0 }\n");
  EXPECT_EQ(s.mesh.structural, 2.0);
  EXPECT_EQ(s.mesh.shear, 0);
  EXPECT_EQ(s.mesh.bend, 0);
}

TEST(SceneFile, readsByteOrderMarksAndCarriageReturns) {
  const Scene s = read_inputs(folder + "good/windows.toml", "", {}).scene;
  EXPECT_EQ(s.name, "windows");
  const Mesh mesh = build_mesh(s);
  EXPECT_EQ(mesh.nodes(), 3u);
  EXPECT_THAT(mesh.pinned, ElementsAre(false, false, true)); // up is z
}

TEST(SceneFile, remembersWhereEachKeyStands) {
  const Scene s = scene_of("[mesh]\ngrid = {}\n\nmass = 2.0\n", {"mesh.planar=true"});
  EXPECT_EQ(s.lines.at("mesh.mass"), 4);
  EXPECT_EQ(s.lines.at("mesh.planar"), 0);
  EXPECT_EQ(s.lines.count("mesh.rest"), 0u);
}

TEST(ShippedScenes, areListedInOrder) {
  EXPECT_THAT(input::shipped_names(input::Shipped::scene),
              ::testing::IsSupersetOf({"flag-225", "flag-400", "flag-400-literal", "spot", "two-nodes"}));
  const std::vector<std::string> names = input::shipped_names(input::Shipped::scene);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_EQ(input::shipped_folder(input::Shipped::scene), HOPMESH_SOURCE_DIR "/sim/scenes");
}

TEST(ShippedScenes, areNamedAsTheirFilesAndBuild) {
  for (const std::string& name : input::shipped_names(input::Shipped::scene)) {
    const Scene s = read_inputs(name, "", {}).scene;
    EXPECT_EQ(s.name, name);
    if (!s.mesh.grid) continue;
    EXPECT_GT(build_mesh(s).springs.size(), 0u) << name;
  }
}

TEST(ShippedScenes, spotHangsByItsTop) {
  const Scene s = read_inputs("spot", "", {}).scene;
  if (!std::filesystem::exists(*s.mesh.file)) GTEST_SKIP() << *s.mesh.file << " is not here";
  const Mesh mesh = build_mesh(s);
  EXPECT_EQ(mesh.nodes(), 2930u);
  EXPECT_EQ(mesh.triangles.size(), 5856u);
  EXPECT_EQ(mesh.springs.size(), 8784u); // a closed surface of triangles: 3/2 edges a face; V - E + F = 2
  const double highest = 20 * 0.953646,
               reach = 0.02 * 20 * (0.953646 + 0.736784); // extremes of y in the file
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    EXPECT_EQ(mesh.pinned[i], mesh.position[i][1] >= highest - reach) << i;
}

TEST(ShippedScenes, spotSaysWhatToDoWithoutItsMesh) {
  const Scene s = read_inputs("spot", "", {"mesh.file=/nowhere/spot.obj"}).scene;
  EXPECT_EQ(complaint([&] { build_mesh(s); }), "--set: mesh.file: found no file /nowhere/spot.obj, expected "
                                               "the OBJ mesh of this scene: put it there, or name "
                                               "yours with --set mesh.file=PATH");
}

TEST(ShippedScenes, aNameIsNotHiddenByAFolder) {
  const Folder temp;
  const auto before = std::filesystem::current_path();
  std::filesystem::create_directory((temp / "flag-400"));
  std::filesystem::current_path((temp / ""));
  const Scene s = read_inputs("flag-400", "", {}).scene;
  std::filesystem::current_path(before);
  EXPECT_EQ(s.mesh.grid->rows, 20);
}

/// docs/method/theory.md, section 4 and Table I of the paper.
TEST(ShippedScenes, flagsHaveThePapersNumbers) {
  const Scene large = read_inputs("flag-400", "", {}).scene, small = read_inputs("flag-225", "", {}).scene;
  EXPECT_EQ(large.motion.time_step, 0.05);
  EXPECT_EQ(large.motion.friction, 0.99);
  EXPECT_EQ(large.probe.gamma, 4000);
  EXPECT_EQ(small.probe.gamma, 8000);
  EXPECT_EQ(build_mesh(large).nodes(), 400u);
  EXPECT_EQ(build_mesh(small).nodes(), 225u);
  const Scene literal = read_inputs("flag-400-literal", "", {}).scene;
  EXPECT_EQ(literal.probe.acceleration_memory, 1.0);
  EXPECT_EQ(literal.probe.force_on, ForceOn::acceleration);
  EXPECT_EQ(literal.probe.energy_springs, EnergySprings::all);
}

} // namespace
} // namespace hopmesh::tests
