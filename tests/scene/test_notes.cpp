// A key that has no effect where it stands is told, and nothing else is.
#include "sim/input/shipped.h"
#include "tests/scene/scene_makers.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace scene;

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::IsEmpty;

std::vector<std::string> notes_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const Folder temp;
  return read_inputs(temp.write("s.toml", text), "", overrides).notes;
}

const std::string incremental =
    "[mesh]\ngrid = { rows = 2, columns = 2 }\n[motion]\nformulation = \"incremental\"\n";

TEST(Notes, tellAKeyOfAnotherFormulation) {
  EXPECT_THAT(notes_of(incremental + "[probe]\ngamma = 1\n"),
              ElementsAre(EndsWith("s.toml:6: probe.gamma: no effect here; it counts only with "
                                   "motion.formulation = \"probe\"")));
  EXPECT_THAT(notes_of(incremental, {"motion.formulation=probe", "incremental.rule=bdf2"}),
              ElementsAre("--set: incremental.rule: no effect here; it counts only with "
                          "motion.formulation = \"incremental\""));
}

TEST(Notes, tellWhatAStaticSceneHasNoUseFor) {
  EXPECT_THAT(notes_of(incremental + "friction = 0.5\n[incremental]\nrule = \"static\"\n[force]\ndrag = 2\n"),
              ElementsAre(EndsWith("friction: no effect here; it counts only with a motion through time, not "
                                   "incremental.rule = \"static\""),
                          EndsWith("drag: no effect here; it counts only with a motion through time, not "
                                   "incremental.rule = \"static\"")));
}

// Files written by the program spell out every default, and "no friction" is what a static scene means.
TEST(Notes, areSilentAboutDefaultsAndAboutNothing) {
  EXPECT_THAT(notes_of(incremental + "[probe]\ngamma = 4000\n"), IsEmpty());
  EXPECT_THAT(notes_of(incremental, {"probe.gamma=4000"}).size(), 1) << "an override is meant";
  EXPECT_THAT(notes_of(incremental + "friction = 1\n[incremental]\nrule = \"static\"\n"), IsEmpty());
  EXPECT_THAT(notes_of(incremental + "[mesh.start]\nseed = 3\nshuffle = 0.1\n"), IsEmpty());
  EXPECT_THAT(notes_of(incremental + "[mesh.start]\nseed = 3\n").size(), 1);
}

TEST(Notes, areSilentAboutShippedScenesAndWhatIsWrittenOfThem) {
  for (const std::string& name : input::shipped_names(input::Shipped::scene)) {
    const Inputs inputs = read_inputs(name, "", {});
    EXPECT_THAT(inputs.notes, IsEmpty()) << name;
    EXPECT_THAT(notes_of(scene_text(inputs.scene)), IsEmpty()) << name;
  }
}

TEST(Notes, tellWhatAStopAndATableCountWith) {
  const auto notes = [](const std::string& array, const std::vector<std::string>& overrides) {
    return read_inputs("flag-400", array, overrides).notes;
  };
  EXPECT_THAT(notes("", {"relax.share=0.01"}),
              ElementsAre("--set: relax.share: no effect here; it counts only with relax.stop = \"sum\""));
  EXPECT_THAT(notes("", {"relax.share=0.01", "relax.stop=sum"}), IsEmpty());
  EXPECT_THAT(
      notes("", {"relax.threshold=0.01", "relax.stop=sum"}),
      ElementsAre("--set: relax.threshold: no effect here; it counts only with relax.stop = \"change\""));
  EXPECT_THAT(notes("", {"relax.momentum=[0.5]"}),
              ElementsAre("--set: relax.momentum: no effect here; it counts only with array.output = "
                          "\"momentum\""));
  EXPECT_THAT(notes("descent-momentum", {"relax.momentum=[0.5]"}), IsEmpty());
}

TEST(Notes, tellKeysOfAnArray) {
  const auto notes = [](const std::string& array, const std::vector<std::string>& overrides) {
    return read_inputs("flag-400", array, overrides).notes;
  };
  EXPECT_THAT(notes("", {"array.reciprocal_bits=9"}), IsEmpty());
  EXPECT_THAT(notes("descent", {"array.reciprocal_bits=9"}),
              ElementsAre("--set: array.reciprocal_bits: no effect here; it counts only with "
                          "array.normaliser = \"reciprocal\""));
  EXPECT_THAT(notes("", {"array.output=binary", "array.normaliser=divider"}),
              ElementsAre("--set: array.normaliser: no effect here; it counts only with "
                          "an array.output other than \"binary\""));
  EXPECT_THAT(notes("", {"array.relaxation=16"}),
              ElementsAre("--set: array.relaxation: no effect here; it counts only with "
                          "array.output = \"projected\""));
  EXPECT_THAT(notes("descent-projected", {"array.relaxation=16"}), IsEmpty());
  EXPECT_THAT(notes("", {"array.momentum_entries=7"}),
              ElementsAre("--set: array.momentum_entries: no effect here; it counts only with "
                          "array.output = \"momentum\""));
  EXPECT_THAT(notes("", {"array.stages=one"}),
              ElementsAre("--set: array.stages: no effect here; it counts only with array.elements above 0"));
  EXPECT_THAT(notes("", {"array.stages=one", "array.elements=7"}), IsEmpty());
  const Folder temp;
  for (const char* preset :
       {"guarded", "descent", "prescaled", "byte", "folded", "descent-projected", "descent-momentum"}) {
    const std::string text = input::array_text(read_inputs("flag-400", preset, {}).array);
    EXPECT_THAT(notes(temp.write("a.toml", text), {}), IsEmpty()) << preset;
  }
}

} // namespace
} // namespace hopmesh::tests
