// A row is all it takes: keys that no program knows are read, written, noted and walked by the table that has
// them.
#include "rtl_model/spec/presets.h"
#include "sim/scene/scene_reader.h"
#include "tests/scene/scene_makers.h"
#include "tests/support/own_array_keys.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

using namespace own;
using ::testing::HasSubstr;

// ---- scenes: a spin that only the probe knows

double spin;

input::Keys with_spin(Scene& scene) {
  input::Keys keys = scene_keys(scene);
  const input::When probe{scene.motion.formulation == Formulation::probe, "motion.formulation = \"probe\""};
  keys.push_back(input::Key("force.spin", &spin, {0, 10, "a spin from 0 to 10"}, "turns").counts(probe));
  return keys;
}

Scene read_with_spin(const std::string& text) {
  return read_scene(input::TomlSource::of_text(text, "s.toml"), "s.toml", with_spin);
}

const std::string grid = "[mesh]\ngrid = { rows = 2, columns = 2 }\n";

TEST(SceneTable, readsAndWritesARowOfYourOwn) {
  spin = 0;
  const Scene scene = read_with_spin(grid + "[force]\nspin = 2.5\n");
  EXPECT_EQ(spin, 2.5);
  const std::string text = scene_text(scene, with_spin);
  EXPECT_THAT(text, HasSubstr("\n[force]\ngravity = [0.0, 0.0, 0.0]\ndrag = 0.0\nspin = 2.5\n"));
  spin = 0;
  read_with_spin(text);
  EXPECT_EQ(spin, 2.5);
}

TEST(SceneTable, refusesARowOfYourOwnInItsWords) {
  EXPECT_EQ(complaint([] { read_with_spin(grid + "[force]\nspin = 11\n"); }),
            "s.toml:4: force.spin: found 11, expected a spin from 0 to 10");
  EXPECT_EQ(complaint([] { read_with_spin(grid + "[force]\nspn = 1\n"); }),
            "s.toml:4: force.spn: found an unknown key, expected drag, gravity, image, spin, wind (did you "
            "mean force.spin?)");
  EXPECT_THAT(complaint([] {
                read_scene(input::TomlSource::of_text(grid + "[force]\nspin = 1\n", "s.toml"), "s.toml");
              }),
              HasSubstr("force.spin: found an unknown key"));
}

std::vector<std::string> notes_of(const std::string& text) {
  const input::TomlSource source = input::TomlSource::of_text(text, "s.toml");
  double unset = 0;
  Scene fresh, scene = read_scene(source, "s.toml", with_spin);
  input::Keys defaults = with_spin(fresh);
  defaults.back().place = &unset;
  return input::without_effect(source, with_spin(scene), defaults);
}

TEST(SceneTable, tellsWhereARowOfYourOwnHasNoEffect) {
  EXPECT_THAT(notes_of(grid + "[force]\nspin = 1\n"), ::testing::IsEmpty());
  EXPECT_THAT(notes_of(grid + "[motion]\nformulation = \"incremental\"\n[force]\nspin = 1\n"),
              ::testing::ElementsAre("s.toml:6: force.spin: no effect here; it counts only with "
                                     "motion.formulation = \"probe\""));
}

// ---- arrays: a number, a mode and a format

TEST(ArrayTable, readsAndWritesRowsOfYourOwn) {
  set(7, Colour::blue, narrow);
  const std::string text = input::array_text(spec::default_array(), with_more);
  EXPECT_THAT(text, HasSubstr("depth = 7\n"));
  EXPECT_THAT(text, HasSubstr("colour = \"blue\"\n"));
  EXPECT_THAT(text, HasSubstr("ratio = \"fixed<9,3,SC_RND,SC_WRAP>\"\n"));
  set(0, Colour::red, {});
  input::array_of(input::TomlSource::of_text(text, "a.toml"), "a.toml", with_more);
  EXPECT_EQ(depth, 7);
  EXPECT_EQ(colour, Colour::blue);
  EXPECT_EQ(ratio, narrow);
  EXPECT_EQ(complaint([] {
              input::array_of(input::TomlSource::of_text("[array]\ndepth = 10\n", "a.toml"), "a.toml",
                              with_more);
            }),
            "a.toml:2: array.depth: found 10, expected 1 to 9");
  EXPECT_THAT(complaint([&] { input::array_of(input::TomlSource::of_text(text, "a.toml"), "a.toml"); }),
              HasSubstr("array.depth: found an unknown key"));
}

} // namespace
} // namespace hopmesh::tests
