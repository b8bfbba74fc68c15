// What may be lowered on an array: every setting on the way can be built, and means what its words say.
#include "rtl_model/spec/presets.h"
#include "sim/study/size/sizing.h"

#include "tests/support/small_scenes.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace study;
using levels::BuiltMesh;

class SizingTest : public ::testing::Test {
 protected:
  scene::Inputs inputs{grid_scene(4, 5), spec::default_array()};
  BuiltMesh mesh{inputs.scene};

  std::optional<spec::SpecFault> fault(const Sizing& sizing, const Setting& setting) const {
    return spec::validate(sizing.array_of(setting), mesh.topology().most_taps());
  }
};

TEST_F(SizingTest, TheWidestCanBeBuiltAndNothingWider) {
  for (const spec::ArraySpec& preset : spec::presets()) {
    inputs.array = preset;
    const Sizing sizing(inputs, mesh);
    const Setting widest = sizing.widest();
    EXPECT_FALSE(fault(sizing, widest)) << preset.name;
    Setting wider = widest;
    ++wider[k_weight], ++wider[k_link];
    EXPECT_TRUE(fault(sizing, wider)) << preset.name;
  }
}

TEST_F(SizingTest, EveryKnobGoesDownToWhatCanStillBeBuilt) {
  const Sizing sizing(inputs, mesh);
  for (std::size_t knob = 0; knob <= k_reciprocal; ++knob) {
    Setting at = sizing.widest();
    while (const auto lower = sizing.lowered(at, knob, 1)) at = *lower;
    EXPECT_FALSE(fault(sizing, at)) << knob_names[knob] << ' ' << fault(sizing, at)->found;
    --at[knob];
    if (knob == k_state) --at[k_link];
    const bool word =
        knob == k_reciprocal || sizing.array_of(at).formats.link.width < 4 || fault(sizing, at).has_value();
    EXPECT_TRUE(word) << knob_names[knob] << " could go lower";
  }
}

TEST_F(SizingTest, AStateTakesTheLinkWithIt) {
  const Sizing sizing(inputs, mesh);
  Setting at = sizing.widest();
  at[k_state] = at[k_link] = 10;
  const auto lower = sizing.lowered(at, k_state, 2);
  ASSERT_TRUE(lower);
  EXPECT_EQ((*lower)[k_state], 8);
  EXPECT_EQ((*lower)[k_link], 8);
  EXPECT_EQ((*sizing.lowered(at, k_link, 2))[k_state], 10);
}

TEST_F(SizingTest, OnlyAReciprocalHasBitsOfOne) {
  inputs.array = spec::descent_array();
  const Sizing sizing(inputs, mesh);
  EXPECT_FALSE(sizing.lowered(sizing.widest(), k_reciprocal, 1));
}

// Codes of bias up to 5 (of 9 integer bits) fit -8 ... 8: four bits, sign included.
TEST_F(SizingTest, KeepsTheIntegerBitsThatWereSeen) {
  Sizing sizing(inputs, mesh);
  const auto& f = inputs.array.formats;
  sizing.keep_integer_bits({{"weight", f.weight, -f.weight.one_raw(), f.weight.max_raw()},
                            {"bias", f.bias, -3 * f.bias.one_raw(), 5 * f.bias.one_raw()}});
  const spec::ArraySpec array = sizing.array_of(sizing.widest());
  EXPECT_EQ(array.formats.weight.integer_bits, 1);
  EXPECT_EQ(array.formats.bias.integer_bits, 4);
  EXPECT_EQ(array.formats.state.integer_bits, 2);
}

TEST_F(SizingTest, AThresholdDoublesAndOverridesSaySo) {
  inputs.scene.relax.threshold = 0.001;
  const Sizing sizing(inputs, mesh);
  Setting at = sizing.widest();
  for (const std::string& word : sizing.overrides(at)) EXPECT_EQ(word.find("relax."), std::string::npos);
  at[k_threshold] -= 3, at[k_sweeps] = 17;
  EXPECT_DOUBLE_EQ(sizing.inputs_of(at).scene.relax.threshold, 0.008);
  EXPECT_EQ(sizing.inputs_of(at).scene.relax.max_sweeps, 17);
  const auto words = sizing.overrides(at);
  EXPECT_EQ(std::count(words.begin(), words.end(), "relax.threshold=0.008"), 1);
  EXPECT_EQ(std::count(words.begin(), words.end(), "relax.max_sweeps=17"), 1);
}

// Two nodes, one of them pinned: 3 neurons of 3 taps, and so 9 weights. By hand, of the default array: s has
// 15 + 14 bits behind its point and 10 before it, N 15 and 9, a reciprocal 18 and 5 for the length of N.
TEST_F(SizingTest, SiliconIsMemoryAndMultipliers) {
  inputs.scene = grid_scene(1, 2);
  const BuiltMesh two(inputs.scene);
  const Sizing sizing(inputs, two);
  Setting at = sizing.widest();
  const spec::Formats formats = spec::default_array().formats;
  for (std::size_t knob = 0; knob < format_knobs; ++knob)
    at[knob] = (formats.*format_of(knob)).fraction_bits();
  at[k_reciprocal] = 18, at[k_lanes] = 1;
  const double memory = 9 * 16 + 3 * (24 + 24 + 16 + 24 + 23 + 39);
  EXPECT_EQ(sizing.silicon_bits(at), memory + 3 * (16 * 16 + 24 * 18 + 39 * 18));
}

TEST_F(SizingTest, AnAccumulatorOfItsOwnIsRefused) {
  inputs.array.exact_accumulator = false;
  EXPECT_THROW(Sizing(inputs, mesh), input::InputError);
}

} // namespace
} // namespace hopmesh::tests
