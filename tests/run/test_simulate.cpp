// The time-step loop with a motion that does what it is told.
#include "sim/run/simulation.h"

#include <chrono>
#include <gmock/gmock.h>
#include <thread>

namespace hopmesh::tests {
namespace {

using run::Outcome;
using ::testing::HasSubstr;

class ToldMotion : public levels::Mover {
 public:
  std::uint64_t diverge_at = UINT64_MAX, stop_at = UINT64_MAX, stretch_at = UINT64_MAX, done = 0;
  double stretch = 10;

  levels::StepRow advance() override {
    if (done == diverge_at) throw levels::LostMotion("node 3 has no finite position");
    if (done == stop_at) throw levels::Stopped();
    levels::StepRow row;
    row.step = done++;
    row.max_stretch = row.step == stretch_at ? stretch : 1;
    return row;
  }
  const std::vector<double>& positions() const override { return position_; }
  levels::StepState state() const override { return {done, position_, {}, {}, {}, {}, {}, {}}; }
  void restore(const levels::StepState& state, const std::vector<levels::SignalRange>&) override {
    done = state.step;
  }

 private:
  std::vector<double> position_{0, 0, 0};
};

struct Log : run::StepSink {
  std::vector<std::uint64_t> steps;
  std::atomic<bool>* stop = nullptr;
  void step(const levels::StepRow& row, const levels::Mover&) override {
    steps.push_back(row.step);
    if (stop && row.step == 2) *stop = true;
  }
};

class Simulate : public ::testing::Test {
 protected:
  run::RunResult run(std::uint64_t steps) { return run::simulate(motion, steps, {&first, &second}, stop); }
  ToldMotion motion;
  Log first, second;
  std::atomic<bool> stop{false};
};

TEST_F(Simulate, DoesAllStepsAndShowsThemToEverybody) {
  const auto result = run(4);
  EXPECT_EQ(result.outcome, Outcome::finished);
  EXPECT_EQ(result.sentence, "All 4 steps done.");
  EXPECT_EQ(result.rows.size(), 4u);
  EXPECT_THAT(first.steps, ::testing::ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(second.steps, first.steps);
  EXPECT_GE(result.wall_seconds, 0);
}

// A figure of the machine that neighbours and sleep would spoil is counted on the processor, not on the wall.
TEST_F(Simulate, SleepIsWallTimeAndNoProcessorTime) {
  struct Sleeper : ToldMotion {
    levels::StepRow advance() override {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      return ToldMotion::advance();
    }
  } sleeper;
  const auto result = run::simulate(sleeper, 3, {}, stop);
  EXPECT_GE(result.wall_seconds, 0.09);
  EXPECT_GT(result.processor_seconds, 0);
  EXPECT_LT(result.processor_seconds, 0.045);
}

TEST_F(Simulate, OneStepIsNotSeveral) {
  EXPECT_EQ(run(1).sentence, "The one step is done.");
  for (const auto& [at, kept] : {std::pair{0, "No step was done before it."},
                                 {1, "The one step before it is kept."},
                                 {2, "The 2 steps before it are kept."}}) {
    ToldMotion breaks;
    breaks.diverge_at = at;
    EXPECT_THAT(run::simulate(breaks, 9, {}, stop).sentence, HasSubstr(kept));
  }
}

TEST_F(Simulate, ADivergedStepIsNotRecorded) {
  motion.diverge_at = 3;
  const auto result = run(9);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.sentence, HasSubstr("in step 3: node 3 has no finite position"));
  EXPECT_EQ(result.rows.size(), 3u);
  EXPECT_EQ(first.steps.size(), 3u);
}

TEST_F(Simulate, AStepStretchedTooFarIsRecordedAndIsTheLast) {
  motion.stretch_at = 2;
  motion.stretch = 12.5;
  const auto result = run(9);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.sentence,
              HasSubstr("in step 2 of 9: a spring is 12.5 times its length (the limit is 10)"));
  EXPECT_EQ(result.rows.size(), 3u);
  EXPECT_THAT(first.steps, ::testing::ElementsAre(0, 1, 2));
}

TEST_F(Simulate, TheLimitItselfIsTooFarAndJustBelowIsNot) {
  motion.stretch_at = 1;
  motion.stretch = std::nextafter(run::most_stretch, 0.0);
  EXPECT_EQ(run(3).outcome, Outcome::finished);
  motion = ToldMotion();
  motion.stretch_at = 1;
  motion.stretch = run::most_stretch;
  EXPECT_EQ(run(3).outcome, Outcome::diverged);
  motion = ToldMotion();
  motion.stretch_at = 1;
  motion.stretch = std::nan("");
  EXPECT_EQ(run(3).outcome, Outcome::diverged);
}

TEST_F(Simulate, StopsBetweenSteps) {
  second.stop = &stop;
  const auto result = run(9);
  EXPECT_EQ(result.outcome, Outcome::interrupted);
  EXPECT_THAT(result.sentence, HasSubstr("Interrupted after 3 of 9 steps"));
  EXPECT_EQ(result.rows.size(), 3u);
}

TEST_F(Simulate, AStopAfterTheLastStepChangesNothing) {
  second.stop = &stop;
  EXPECT_EQ(run(3).outcome, Outcome::finished);
}

TEST_F(Simulate, AnInterruptedStepDidNotHappen) {
  motion.stop_at = 1;
  const auto result = run(9);
  EXPECT_EQ(result.outcome, Outcome::interrupted);
  EXPECT_THAT(result.sentence, HasSubstr("Interrupted after 1 of 9 steps"));
  EXPECT_EQ(first.steps.size(), 1u);
}

} // namespace
} // namespace hopmesh::tests
