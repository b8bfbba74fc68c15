// --set key.path=value: any key, TOML values or bare words, the last one wins, mistakes name --set.
#include "tests/scene/scene_makers.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string grid = "[mesh]\ngrid = { rows = 3, columns = 4, pitch = 2.0 }\nsprings = { shear = 0.5 }\n";

Scene with(const std::vector<std::string>& overrides) {
  return scene_of(grid, overrides);
}

spec::ArraySpec array_with(const std::vector<std::string>& overrides, const std::string& array = "") {
  return read_inputs(folder + "good/every_key.toml", array, overrides).array;
}

std::string complaint_with(const std::string& override) {
  return complaint([&] { with({override}); });
}

TEST(Overrides, changeOneKeyAndLeaveItsNeighbours) {
  const Scene s = with({"mesh.grid.rows=8", "mesh.springs.bend=0.5", "motion.steps = 3"});
  EXPECT_EQ(s.mesh.grid->rows, 8);
  EXPECT_EQ(s.mesh.grid->columns, 4);
  EXPECT_EQ(s.mesh.grid->pitch, 2.0);
  EXPECT_EQ(s.mesh.shear, 0.5);
  EXPECT_EQ(s.mesh.bend, 0.5);
  EXPECT_EQ(s.motion.steps, 3);
}

TEST(Overrides, takeTomlValues) {
  const Scene s =
      with({"force.wind=[1,0,-0.5]", "mesh.pinned=[\"left\", 3]", "name=\"a b\"", "mesh.planar=true"});
  EXPECT_THAT(*s.force.wind, ElementsAre(1, 0, -0.5));
  EXPECT_THAT(s.mesh.pinned, ElementsAre(Pin("left"), Pin(std::int64_t{3})));
  EXPECT_EQ(s.name, "a b");
  EXPECT_TRUE(s.mesh.planar);
}

TEST(Overrides, takeBareWords) {
  const Scene s =
      with({"mesh.pinned=left", "mesh.rest=natural", "name=my flag = 2", "probe.force_on = acceleration"});
  EXPECT_THAT(s.mesh.pinned, ElementsAre(Pin("left")));
  EXPECT_EQ(s.name, "my flag = 2");
  EXPECT_EQ(s.probe.force_on, "acceleration");
}

TEST(Overrides, replaceAWholeTable) {
  const Scene s = with({"mesh.grid={ rows = 5 }"});
  EXPECT_EQ(s.mesh.grid->rows, 5);
  EXPECT_EQ(s.mesh.grid->columns, 20);
  EXPECT_EQ(s.mesh.grid->pitch, 1.0);
}

TEST(Overrides, applyInOrder) {
  EXPECT_EQ(with({"mesh.mass=2", "mesh.mass=3"}).mesh.mass, 3.0);
}

TEST(Overrides, aFileReplacesTheGrid) {
  const Scene s = with({"mesh.file=/x/y.obj", "mesh.up=y"});
  EXPECT_FALSE(s.mesh.grid);
  EXPECT_EQ(s.mesh.file, "/x/y.obj");
  EXPECT_EQ(s.mesh.shear, 0); // the grid's shear springs went with the grid
  EXPECT_EQ(s.mesh.up, "y");
}

TEST(Overrides, aFileIsMeantFromWhereTheUserStands) {
  EXPECT_EQ(with({"mesh.file=y.obj"}).mesh.file, (std::filesystem::current_path() / "y.obj").string());
}

TEST(Overrides, aGridReplacesTheFile) {
  const Scene s =
      scene_of("[mesh]\nfile = \"x.obj\"\nscale = 2.0\nup = \"y\"\npin_band = 0.1\n", {"mesh.grid.rows=6"});
  EXPECT_FALSE(s.mesh.file);
  EXPECT_EQ(s.mesh.grid->rows, 6);
  EXPECT_EQ(s.mesh.shear, 1.0);
  EXPECT_EQ(s.mesh.up, "z");
}

TEST(Overrides, reachTheArray) {
  const spec::ArraySpec a =
      array_with({"array.lanes=9", "formats.link=fixed<12,2,SC_RND,SC_SAT>", "array.schedule=sequential"});
  EXPECT_EQ(a.lanes, 9);
  EXPECT_EQ(a.formats.link.text(), "fixed<12,2,SC_RND,SC_SAT>");
  EXPECT_EQ(a.schedule, spec::Schedule::sequential);
  EXPECT_EQ(a.name, "custom"); // it is no longer the preset
}

TEST(Overrides, reachTheArrayOfAFileAndAPreset) {
  EXPECT_EQ(array_with({"array.lanes=2"}, "descent").normaliser, spec::Normaliser::divider);
  const spec::ArraySpec a = array_with({"formats.accumulator=exact"}, folder + "good/every_array_key.toml");
  EXPECT_TRUE(a.exact_accumulator);
  EXPECT_EQ(a.lanes, 9);
  EXPECT_EQ(a.name, "mine");
}

TEST(Overrides, mistakesNameSet) {
  EXPECT_EQ(complaint_with("motion.steps=0"),
            "--set: motion.steps: found 0, expected an integer from 1 to 1000000000");
  EXPECT_EQ(complaint_with("motion.steps=many"),
            "--set: motion.steps: found \"many\", expected an integer from 1 to 1000000000");
  EXPECT_THAT(complaint_with("motion.step=3"), StartsWith("--set: motion.step: found an unknown key"));
  EXPECT_THAT(complaint_with("motion.step=3"), HasSubstr("(did you mean motion.steps?)"));
  EXPECT_THAT(complaint_with("force.wind=[1,0]"), StartsWith("--set: force.wind: found a list of 2"));
  EXPECT_THAT(complaint_with("force.wind=[1,0"), StartsWith("--set: force.wind: found \"[1,0\""));
  EXPECT_THAT(complaint_with("mesh.springs=3"), StartsWith("--set: mesh.springs: found 3, expected a table"));
  EXPECT_THAT(complaint_with("mesh.grid.rows.x=3"), StartsWith("--set: mesh.grid.rows: found a table"));
}

TEST(Overrides, mistakesInTheArrayNameSet) {
  const auto complaint_of = [](const std::string& override) {
    return complaint([&] { array_with({override}); });
  };
  EXPECT_EQ(complaint_of("array.lanes=0"), "--set: array.lanes: found 0, expected 1 to 64");
  EXPECT_EQ(
      complaint_of("formats.state=fixed<12,2,SC_RND,SC_SAT>"),
      "--set: formats.link: found fixed<16,2,SC_RND,SC_SAT>, expected at most the state's 10 fraction bits");
  EXPECT_THAT(complaint_of("array.lane=3"), HasSubstr("--set: array.lane: found an unknown key"));
  EXPECT_THAT(complaint_of("array=3"), StartsWith("--set: array: found 3, expected a table"));
}

TEST(Overrides, mistakesThatShowInTheMeshNameSet) {
  EXPECT_EQ(complaint([] { build_mesh(with({"mesh.pinned=99"})); }),
            "--set: mesh.pinned: found node 99, expected node numbers from 0 to 11");
}

TEST(Overrides, mustHaveTheirShape) {
  for (const char* text : {"", "=", "=3", "steps", ".a=1", "a.=1", "a..b=1", "a b=1", "\"a\"=1", "a\n=1"})
    EXPECT_THAT(complaint_with(text), HasSubstr("expected key.path=value")) << text;
}

TEST(Overrides, cannotSmuggleInASecondKey) {
  EXPECT_THAT(complaint_with("motion.steps=3\nx = 1"), HasSubstr("motion.steps: found \"3\\x0Ax = 1\""));
}

} // namespace
} // namespace hopmesh::tests
