// Levels beside each other, one of them with a fault to order.
#include "rtl_model/spec/presets.h"
#include "sim/cosim/compare.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/run_totals.h"
#include "tests/support/small_scenes.h"
#include "tests/support/soft_array.h"

#include <deque>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using run::Outcome;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class Compare : public ::testing::Test {
 protected:
  void add_reference() { add(levels::level_named("reference", "")); }
  void add_array(const std::string& name, std::optional<Fault> fault = {}) {
    levels::Level level{name};
    level.can_wave = true;
    level.make_port = [this, fault](const auto& its_array, const auto& topology, const auto&) {
      auto port = std::make_unique<SoftArray>(its_array, topology, fault);
      ports.push_back(port.get());
      return port;
    };
    add(rows.emplace_back(level));
  }
  void add(const levels::Level& level) {
    prepared.inputs = {scene, array};
    ready.push_back(levels::make_ready(level, prepared, !ready.empty() && !ready[0].array));
  }
  cosim::Comparison run(std::uint64_t steps) {
    return cosim::compare(
        ready, *prepared.mesh, array, steps, [this](const levels::StepRow& row) { seen.push_back(row.step); },
        stop);
  }
  static std::uint64_t sum(const cosim::Comparison& c, std::size_t level,
                           std::uint64_t levels::StepRow::*figure) {
    return run::count_of(c.levels.at(level).rows, figure, levels::Summary::sum);
  }
  std::string text(const cosim::Comparison& c) const { return cosim::text_of(c, "grid", array); }

  scene::Scene scene = grid_scene(2, 3);
  spec::ArraySpec array = *spec::preset("descent");
  levels::Prepared prepared{{scene, array}, std::make_unique<levels::BuiltMesh>(scene)};
  std::deque<levels::Level> rows;
  std::vector<SoftArray*> ports;
  std::vector<levels::ReadyLevel> ready;
  std::vector<std::uint64_t> seen;
  std::atomic<bool> stop{false};
};

TEST_F(Compare, EqualLevelsAreEqual) {
  add_array("one"), add_array("two"), add_array("three");
  const auto c = run(3);
  EXPECT_EQ(c.outcome, Outcome::finished);
  EXPECT_EQ(c.steps, 3u);
  EXPECT_EQ(c.pairs, 2u);
  EXPECT_FALSE(c.difference);
  EXPECT_THAT(seen, ElementsAre(0, 1, 2));
  EXPECT_GT(sum(c, 0, &levels::StepRow::cycles), 0u);
  EXPECT_EQ(sum(c, 0, &levels::StepRow::cycles), sum(c, 2, &levels::StepRow::cycles));
  EXPECT_TRUE(c.levels[0].distances.empty());
  EXPECT_THAT(text(c), HasSubstr("Fixed levels: equal after each of " +
                                 std::to_string(sum(c, 0, &levels::StepRow::sweeps)) +
                                 " sweeps, every code; sweep and cycle counts of every step too."));
}

TEST_F(Compare, StopsAtTheFirstDifferenceAndExplainsIt) {
  scene.relax = {0, 5, 1}; // no time to heal: the fifth sweep is the last
  // Each step loads the outputs twice: for its run, and for the run in lockstep. The third load is step 1.
  add_array("good"), add_array("bad", Fault{5, 7, 1, 2});
  const auto c = run(9);
  ASSERT_TRUE(c.difference);
  EXPECT_EQ(c.steps, 2u);
  EXPECT_EQ(c.difference->step, 1u);
  EXPECT_EQ(c.difference->level[0], "good");
  EXPECT_EQ(c.difference->level[1], "bad");
  ASSERT_TRUE(c.difference->where);
  EXPECT_EQ(c.difference->where->sweep, 5u);
  EXPECT_EQ(c.difference->where->node, 4u);
  EXPECT_EQ(c.difference->where->component, 1u);
  EXPECT_EQ(c.difference->where->raw[0] ^ c.difference->where->raw[1], 1);
  EXPECT_THAT(text(c), HasSubstr("good and bad differ first in step 1"));
  EXPECT_THAT(text(c), HasSubstr("sweep 5, cycle "));
  EXPECT_THAT(text(c), HasSubstr("node 4, neuron 1: V "));
  EXPECT_THAT(text(c),
              HasSubstr("hopmesh run grid --level bad --no-check --steps 2 --out out/difference --wave "
                        "difference.vcd --wave-window "));
  const std::uint64_t at = c.difference->cycles_before + c.difference->where->cycle, sweep = 361;
  EXPECT_EQ(c.difference->cycles_before, sum(c, 0, &levels::StepRow::cycles) - c.difference->cycles[0]);
  EXPECT_THAT(text(c), HasSubstr(std::to_string(at - sweep) + ":" + std::to_string(at + sweep) +
                                 "c --wave-cells 2\n"));
  EXPECT_THAT(text(c), Not(HasSubstr("Fixed levels: equal")));
}

TEST_F(Compare, AFaultThatHealsBeforeRestIsFound) {
  scene.relax = {1e-3, 300, 1};
  add_array("good"), add_array("bad", Fault{2, 7, 1, 2});
  const auto c = run(9);
  ASSERT_TRUE(c.difference);
  EXPECT_EQ(c.difference->step, 1u);
  ASSERT_TRUE(c.difference->where);
  EXPECT_EQ(c.difference->where->sweep, 2u);
  EXPECT_EQ(c.difference->where->node, 4u);
  EXPECT_EQ(ready[0].array->rest_raw(), ready[1].array->rest_raw()); // at rest nothing is left of it
  EXPECT_EQ(c.difference->sweeps[0], c.difference->sweeps[1]);
}

TEST_F(Compare, AFaultInTheRunInLockstepAloneIsFoundToo) {
  add_array("good"), add_array("bad", Fault{1, 0, 1, 1}); // from the lockstep of step 0 on
  const auto c = run(2);
  ASSERT_TRUE(c.difference);
  EXPECT_EQ(c.difference->step, 0u);
  ASSERT_TRUE(c.difference->where);
  EXPECT_EQ(c.difference->where->sweep, 1u);
}

TEST_F(Compare, OfSeveralExpansionsTheLastIsRunInLockstep) {
  scene.relax.expansions = 2;
  add_array("one"), add_array("two");
  const auto c = run(3);
  EXPECT_FALSE(c.difference);
  EXPECT_GT(c.sweeps_compared, 0u);
  EXPECT_LT(c.sweeps_compared, sum(c, 0, &levels::StepRow::sweeps));
}

TEST_F(Compare, AnInterruptInTheLockstepEndsIt) {
  add_array("one"), add_array("two");
  const auto c = cosim::compare(
      ready, *prepared.mesh, array, 5, [this](const levels::StepRow&) { ports[1]->stop = true; }, stop);
  EXPECT_EQ(c.outcome, Outcome::interrupted);
}

TEST_F(Compare, AllFixedLevelsAreComparedWithTheFirst) {
  scene.relax = {0, 5, 1};
  add_array("one"), add_array("two"), add_array("three", Fault{5, 0, 4, 0});
  const auto c = run(2);
  ASSERT_TRUE(c.difference);
  EXPECT_EQ(c.difference->level[0], "one");
  EXPECT_EQ(c.difference->level[1], "three");
  EXPECT_EQ(c.difference->step, 0u);
}

TEST_F(Compare, CyclesAloneAreADifferenceToo) {
  add_array("quick"), add_array("slow", Fault{1, 0, 0, 0, 5}); // flips no bit, takes five cycles more
  const auto c = run(2);
  ASSERT_TRUE(c.difference);
  EXPECT_FALSE(c.difference->where);
  EXPECT_EQ(c.difference->cycles[1], c.difference->cycles[0] + 5);
  EXPECT_THAT(text(c), HasSubstr("the fault does not repeat"));
}

TEST_F(Compare, DistancesFromTheReferenceAtOneTenAndTheLastStep) {
  add_reference(), add_array("soft");
  const auto c = run(12);
  ASSERT_EQ(c.levels.size(), 2u);
  EXPECT_TRUE(c.levels[0].distances.empty());
  ASSERT_EQ(c.levels[1].distances.size(), 3u);
  EXPECT_EQ(c.levels[1].distances[0].steps, 1u);
  EXPECT_EQ(c.levels[1].distances[1].steps, 10u);
  EXPECT_EQ(c.levels[1].distances[2].steps, 12u);
  for (const auto& d : c.levels[1].distances) {
    EXPECT_GT(d.largest, 0);
    EXPECT_LE(d.rms, d.largest);
  }
  EXPECT_GT(
      run::total_of(c.levels[1].rows, &levels::ReferenceError::largest_output, levels::Summary::largest), 0);
  EXPECT_EQ(c.pairs, 0u);
  EXPECT_EQ(sum(c, 0, &levels::StepRow::cycles), 0u);
  EXPECT_GT(sum(c, 0, &levels::StepRow::sweeps), 0u);
}

TEST_F(Compare, StopsWhenAsked) {
  add_array("one"), add_array("two");
  stop = true;
  const auto c = run(5);
  EXPECT_EQ(c.outcome, Outcome::interrupted);
  EXPECT_EQ(c.steps, 0u);
  EXPECT_THAT(text(c), HasSubstr("Interrupted after 0 of 5 steps"));
}

TEST_F(Compare, AnInterruptedLevelEndsIt) {
  add_array("one"), add_array("two");
  ports[1]->stop = true;
  const auto c = run(5);
  EXPECT_EQ(c.outcome, Outcome::interrupted);
  EXPECT_EQ(c.steps, 0u);
}

TEST_F(Compare, TellsWhoDiverged) {
  scene.force.gravity = {0, 0, -1e6};
  add_array("one"), add_array("two");
  const auto c = run(50);
  EXPECT_EQ(c.outcome, Outcome::diverged);
  EXPECT_THAT(c.sentence, HasSubstr("diverged in step"));
  EXPECT_LT(c.steps, 50u);
}

} // namespace
} // namespace hopmesh::tests
