// Children of a pool: all are run, a crash is told and stops nobody, a stop ends what runs.
#include "sim/study/point_pool.h"

#include <csignal>
#include <gtest/gtest.h>
#include <map>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

using namespace study;

TEST(PointPool, TellsHowEachChildEnded) {
  const std::atomic<bool> stop{false};
  std::map<std::size_t, std::pair<int, int>> ends;
  const auto work = [](std::size_t n) {
    if (n == 3) std::raise(SIGKILL);
    return n == 5 ? 7 : 0;
  };
  EXPECT_TRUE(run_in_children(
      {1, 3, 5, 8}, 2, work,
      [&](std::size_t n, const ChildEnd& end) {
        ends[n] = {end.exit_code, end.signal};
      },
      stop));
  const std::map<std::size_t, std::pair<int, int>> expected{
      {1, {0, 0}}, {3, {0, SIGKILL}}, {5, {7, 0}}, {8, {0, 0}}};
  EXPECT_EQ(ends, expected);
}

TEST(PointPool, AStopEndsThemBeforeTheirTime) {
  std::atomic<bool> stop{false};
  const auto work = [](std::size_t n) {
    if (n > 0) pause();
    return 0;
  };
  EXPECT_FALSE(run_in_children(
      {0, 1, 2}, 2, work, [&](std::size_t, const ChildEnd&) { stop = true; }, stop));
}

} // namespace
} // namespace hopmesh::tests
