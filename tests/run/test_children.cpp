// Children of a pool: all are run, a crash is told and stops nobody, a stop ends what runs.
#include "sim/run/children.h"

#include <csignal>
#include <gtest/gtest.h>
#include <map>
#include <stdexcept>
#include <unistd.h>

namespace hopmesh::tests {
namespace {

using namespace run;

TEST(Children, TellsHowEachChildEnded) {
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

TEST(Children, AStopEndsThemBeforeTheirTime) {
  std::atomic<bool> stop{false};
  const auto work = [](std::size_t n) {
    if (n > 0) pause();
    return 0;
  };
  EXPECT_FALSE(run_in_children(
      {0, 1, 2}, 2, work, [&](std::size_t, const ChildEnd&) { stop = true; }, stop));
}

TEST(Children, OneChildAloneTellsHowItEnded) {
  EXPECT_EQ(run_in_child([] { return 7; }, 10).exit_code, 7);
  EXPECT_EQ(run_in_child([]() -> int { throw std::runtime_error("no"); }, 10).exit_code, child_failed);
  EXPECT_EQ(run_in_child([] { return std::raise(SIGKILL); }, 10).signal, SIGKILL);
  const auto hang = [] {
    while (pause() == -1) {
    }
    return 0;
  };
  EXPECT_EQ(run_in_child(hang, 1).signal, SIGALRM);
}

// Were it not killed, its owner would wait for it for ever.
TEST(Children, AChildThatIsGivenUpIsKilled) {
  const Child child([] { return pause(); });
}

TEST(Children, TheirEndIsToldInWords) {
  EXPECT_EQ(describe({3, 0}), "ended with exit code 3");
  EXPECT_EQ(describe({0, SIGKILL}), "killed by signal 9 (Killed)");
}

} // namespace
} // namespace hopmesh::tests
