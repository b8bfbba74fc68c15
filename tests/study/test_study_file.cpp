// Study files: axes in their order, keys set together, and every mistake by its line.
#include "sim/input/shipped.h"
#include "sim/study/study_file.h"
#include "tests/support/complaint.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace study;

const std::string start = "scene = \"two-nodes\"\n";

std::string refusal(const std::string& text) {
  return complaint([&] { study_of(text, "s.toml"); });
}

TEST(StudyFile, PlainAxesKeepTheFilesOrderAndTheirValuesAsToml) {
  const Study s =
      study_of(start + "[axes]\n\"relax.threshold\" = [3e-5, 1]\n\"mesh.pinned\" = [\"left\", [0, 1]]\n"
                       "motion.time_step = [0.5]\n",
               "s.toml");
  ASSERT_EQ(s.axes.size(), 3u);
  EXPECT_EQ(s.axes[0].name, "relax.threshold");
  EXPECT_EQ(s.axes[1].name, "mesh.pinned");
  EXPECT_EQ(s.axes[2].name, "motion.time_step");
  EXPECT_EQ(s.axes[0].places[0].label, "3e-05");
  EXPECT_EQ(s.axes[0].places[0].settings[0].text, "3e-05");
  EXPECT_EQ(s.axes[1].places[0].settings[0].text, "\"left\"");
  EXPECT_EQ(s.axes[1].places[1].settings[0].text, "[0, 1]");
  EXPECT_EQ(s.axes[1].places[1].settings[0].line, 4);
  EXPECT_EQ(s.combinations(), 2u * 2u * 1u);
}

TEST(StudyFile, AnAxisWithLabelsSetsKeysTogether) {
  const Study s = study_of(start + "[axes.width]\nlabel = [8, 12]\n\"formats.link\" = \"fixed<{},2>\"\n"
                                   "\"array.lanes\" = [1, 3]\n",
                           "s.toml");
  ASSERT_EQ(s.axes.size(), 1u);
  EXPECT_EQ(s.axes[0].name, "width");
  ASSERT_EQ(s.axes[0].places.size(), 2u);
  EXPECT_EQ(s.axes[0].places[1].label, "12");
  std::vector<std::string> sets;
  for (const StudySetting& set : s.axes[0].places[1].settings) sets.push_back(set.key + '=' + set.text);
  EXPECT_THAT(sets, ::testing::UnorderedElementsAre("formats.link=\"fixed<12,2>\"", "array.lanes=3"));
}

TEST(StudyFile, AnAxisMayNameTheMethods) {
  const std::string axis = "[axes.solver]\nlabel = [\"a\", \"b\"]\nmethod = [\"engine\", \"rk4\"]\n";
  const Study s = study_of(start + axis + "\"motion.steps\" = 3\n", "s.toml");
  EXPECT_EQ(s.combinations(), 2u);
  EXPECT_EQ(s.axes[0].places[1].method, "rk4");
  EXPECT_EQ(s.axes[0].places[1].method_line, 4);
  EXPECT_EQ(s.axes[0].places[1].settings.size(), 1u);
  EXPECT_THAT(refusal(start + "methods = [\"engine\"]\n" + axis),
              ::testing::HasSubstr("s.toml:5: axes.solver.method: found methods named twice"));
  EXPECT_THAT(refusal(start + "[axes.a]\nlabel = [1]\nmethod = [7]\n"),
              ::testing::HasSubstr("s.toml:4: axes.a.method: found 7, expected names of methods"));
}

TEST(StudyFile, MistakesAreToldByTheirLine) {
  EXPECT_THAT(refusal("name = \"x\"\n"), ::testing::HasSubstr("scene: found nothing"));
  EXPECT_THAT(refusal(start + "stpes = 3\n"), ::testing::HasSubstr("s.toml:2: stpes: found an unknown key"));
  EXPECT_THAT(refusal(start + "stpes = 3\n"), ::testing::HasSubstr("mean steps?"));
  EXPECT_THAT(refusal(start + "[axes]\n\"motion.time_step\" = []\n"), ::testing::HasSubstr("s.toml:3: "));
  EXPECT_THAT(refusal(start + "[axes]\n\"motion.time_step\" = 3\n"),
              ::testing::HasSubstr("at least one value"));
  EXPECT_THAT(
      refusal(start + "[axes.w]\nlabel = [1, 2]\n\"array.lanes\" = [1]\n"),
      ::testing::HasSubstr("s.toml:4: axes.w.\"array.lanes\": found a list of 1, expected a list of 2"));
  EXPECT_THAT(refusal(start + "methods = []\n"), ::testing::HasSubstr("s.toml:2: methods"));
  EXPECT_THAT(refusal(start + "methods = [\"engine\", \"engine\"]\n"),
              ::testing::HasSubstr("each method once"));
  EXPECT_THAT(refusal(start + "times = [-1]\n"), ::testing::HasSubstr("s.toml:2: times: found -1"));
}

TEST(StudyFile, EveryShippedStudyIsRead) {
  EXPECT_THAT(
      input::shipped_names(input::Shipped::study),
      ::testing::IsSupersetOf({"all-map", "banner-methods", "first-map", "first-widths", "probe-map"}));
  for (const std::string& name : input::shipped_names(input::Shipped::study))
    EXPECT_EQ(read_study(name).name, name);
}

} // namespace
} // namespace hopmesh::tests
