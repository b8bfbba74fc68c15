// Which frames of a run its report shows.
#include "sim/run/run_picture.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using run::rows_shown;
using ::testing::ElementsAre;

TEST(RowsShown, AllOfAShortRun) {
  EXPECT_THAT(rows_shown(0, 400), ElementsAre());
  EXPECT_THAT(rows_shown(1, 400), ElementsAre(0));
  EXPECT_THAT(rows_shown(4, 400), ElementsAre(0, 1, 2, 3));
}

TEST(RowsShown, EvenlyFirstAndLastIncluded) {
  const auto rows = rows_shown(401, 400);
  ASSERT_EQ(rows.size(), run::most_frames);
  EXPECT_EQ(rows.front(), 0u);
  EXPECT_EQ(rows.back(), 400u);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    EXPECT_GE(rows[k] - rows[k - 1], 1u);
    EXPECT_LE(rows[k] - rows[k - 1], 2u);
  }
}

TEST(RowsShown, ALargeMeshKeepsWithinTheBudget) {
  for (std::size_t nodes : {20000, 30000, 100000, 1000000, 2000000}) {
    const auto rows = rows_shown(1000, nodes);
    EXPECT_LE(rows.size() * nodes * 12, run::most_frame_bytes) << nodes; // three floats a node
    EXPECT_EQ(rows.front(), 0u);
    EXPECT_EQ(rows.back(), 999u);
  }
  EXPECT_THAT(rows_shown(1000, 1000000), ElementsAre(0, 249, 499, 749, 999)); // 67.1 MB for 12 MB each
}

TEST(RowsShown, TwoAtLeastHoweverLargeTheMesh) {
  EXPECT_THAT(rows_shown(1000, 4000000), ElementsAre(0, 999));
  EXPECT_THAT(rows_shown(1, 4000000), ElementsAre(0));
}

TEST(RunPicture, CurvesOfLongRunsShowEveryNthStepAndTheLast) {
  const auto steps_of = [](std::size_t count) {
    run::StepLog rows;
    levels::StepRow row;
    for (row.step = 0; row.step < count; ++row.step) rows.push_back(row);
    std::vector<std::uint64_t> steps;
    for (const auto& drawn : run::rows_drawn(rows)) steps.push_back(drawn.step);
    return steps;
  };
  EXPECT_THAT(steps_of(0), ElementsAre());
  EXPECT_THAT(steps_of(3), ElementsAre(0, 1, 2));
  EXPECT_EQ(steps_of(run::most_points).size(), run::most_points);
  const auto steps = steps_of(10 * run::most_points);
  EXPECT_EQ(steps.size(), run::most_points + 1);
  EXPECT_EQ(steps[1], 10u);
  EXPECT_EQ(steps.back(), 10 * run::most_points - 1);
  const auto of_thinned = steps_of(25 * run::most_points + 1); // of which every fourth was kept
  EXPECT_LE(of_thinned.size(), run::most_points + 1);
  EXPECT_EQ(of_thinned[1], 28u);
  EXPECT_EQ(of_thinned.back(), 25 * run::most_points);
}

TEST(RunPicture, AMeshThatNoBrowserBearsIsDrawnCoarser) {
  pictures::RunView view;
  view.subtitle = "fine";
  const std::size_t side = 400;
  view.nodes = side * side;
  view.pinned.assign(view.nodes, false);
  std::vector<float> frame;
  for (std::size_t k = 0; k < view.nodes; ++k)
    for (const std::size_t at : {k % side, k / side, std::size_t{0}}) frame.push_back(static_cast<float>(at));
  view.frames.assign(3, frame);
  const pictures::RunView drawn = run::report_view(view);
  EXPECT_LE(drawn.nodes, run::most_report_nodes);
  EXPECT_EQ(drawn.frames.size(), 3u);
  EXPECT_EQ(drawn.frames[1].size(), 3 * drawn.nodes);
  EXPECT_THAT(drawn.subtitle, testing::HasSubstr("fine; its 160,000 nodes are drawn as "));
}

scene::Mesh two_nodes(const scene::Vector3& a, const scene::Vector3& b) {
  scene::Mesh mesh;
  mesh.position = {a, b};
  return mesh;
}

TEST(PictureOrigin, IsTheMiddleOfAMeshThatIsFarAway) {
  using run::picture_origin;
  EXPECT_THAT(picture_origin(two_nodes({0, 0, 0}, {1, 2, 3})), ElementsAre(0, 0, 0));
  EXPECT_THAT(picture_origin(two_nodes({60, 0, 0}, {61, 0, 0})), ElementsAre(0, 0, 0));
  EXPECT_THAT(picture_origin(two_nodes({70, 0, -2}, {71, 0.5, -2})), ElementsAre(70.5, 0.25, -2));
  EXPECT_THAT(picture_origin(two_nodes({1e6, 1e6, 1e6}, {1e6, 1e6, 1e6})), ElementsAre(1e6, 1e6, 1e6));
}

} // namespace
} // namespace hopmesh::tests
