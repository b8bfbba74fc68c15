// Array files: presets, every key, names. What may not be built is in tests/scene/bad/array.
#include "rtl_model/spec/presets.h"
#include "tests/scene/scene_makers.h"

namespace hopmesh::tests {
namespace {

using namespace scene;

spec::ArraySpec array_of(const std::string& text) {
  const Folder temp;
  return scene::read_inputs(folder + "good/every_key.toml", temp.write("small.toml", text), {}).array;
}

spec::ArraySpec array_named(const std::string& name) {
  return scene::read_inputs(folder + "good/every_key.toml", name, {"relax.momentum=\"fista\""}).array;
}

TEST(ArrayFile, readsEveryKey) {
  const spec::ArraySpec a = array_named(folder + "good/every_array_key.toml");
  EXPECT_EQ(a.name, "mine");
  EXPECT_EQ(a.schedule, spec::Schedule::sequential);
  EXPECT_EQ(a.lanes, 9);
  EXPECT_EQ(a.elements, 12);
  EXPECT_EQ(a.stages, spec::Stages::one);
  EXPECT_EQ(a.pipeline, 0);
  EXPECT_EQ(a.output, spec::Output::binary);
  EXPECT_EQ(a.normaliser, spec::Normaliser::reciprocal);
  EXPECT_EQ(a.reciprocal_bits, 20);
  EXPECT_EQ(a.bus_bits, 128);
  EXPECT_EQ(a.clock_mhz, 250.0);
  EXPECT_FALSE(a.exact_accumulator);
  EXPECT_EQ(a.formats.weight.text(), "fixed<14,1,SC_RND_CONV,SC_SAT_SYM>");
  EXPECT_EQ(a.formats.bias.text(), "fixed<22,8,SC_RND_INF,SC_SAT_ZERO>");
  EXPECT_EQ(a.formats.accumulator.text(), "fixed<34,12,SC_TRN,SC_WRAP>");
  EXPECT_EQ(a.formats.drive.text(), "fixed<15,3,SC_RND_ZERO,SC_SAT>");
  EXPECT_EQ(a.formats.state.text(), "fixed<20,2,SC_RND_MIN_INF,SC_SAT>");
  EXPECT_EQ(a.formats.link.text(), "fixed<12,2,SC_TRN,SC_WRAP>"); // SystemC's own defaults
}

TEST(ArrayFile, presetsAreThere) {
  for (const spec::ArraySpec& a : spec::presets()) {
    EXPECT_EQ(input::array_text(array_named(a.name)), input::array_text(a));
    EXPECT_EQ(array_named(a.name).name, a.name);
  }
  EXPECT_EQ(input::array_text(array_named("")), input::array_text(spec::default_array()));
}

TEST(ArrayFile, startsFromItsPresetAndIsNamedAfterItself) {
  const spec::ArraySpec a = array_of("preset = \"descent\"\n[array]\nlanes = 9\n");
  EXPECT_EQ(a.lanes, 9);
  EXPECT_EQ(a.normaliser, spec::descent_array().normaliser);
  EXPECT_EQ(a.formats.state, spec::descent_array().formats.state);
  EXPECT_EQ(a.name, "small");
}

TEST(ArrayFile, startsFromTheDefaultWithoutPreset) {
  const spec::ArraySpec a = array_of("[array]\nbus_bits = 64\n");
  EXPECT_EQ(a.bus_bits, 64);
  EXPECT_EQ(a.normaliser, spec::default_array().normaliser);
  EXPECT_EQ(a.formats.drive, spec::default_array().formats.drive);
}

TEST(ArrayFile, aPipelineIsReadWhereTheNormaliserCanHaveIt) {
  EXPECT_EQ(array_of("[array]\npipeline = 4\n").pipeline, 4);
  EXPECT_EQ(array_of("preset = \"prescaled\"\n[array]\npipeline = 3\n").pipeline, 3);
}

TEST(ArrayFile, accumulatorIsExactOrAFormat) {
  EXPECT_TRUE(array_of("[formats]\naccumulator = \"exact\"\n").exact_accumulator);
  const spec::ArraySpec a = array_of("[formats]\naccumulator = \"fixed<36,10,SC_TRN,SC_SAT>\"\n");
  EXPECT_FALSE(a.exact_accumulator);
  EXPECT_EQ(a.formats.accumulator.text(), "fixed<36,10,SC_TRN,SC_SAT>");
}

} // namespace
} // namespace hopmesh::tests
