// Folded arrays: order, rounds and cycles by hand and against an oracle that steps through them.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/presets.h"
#include "tests/support/random_network.h"
#include "tests/support/slow_array.h"
#include "tests/support/slow_fold.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::ArraySpec;
using spec::Schedule;
using spec::Stages;
using spec::Topology;

ArraySpec folded(int elements, Stages stages) {
  ArraySpec a;
  a.elements = elements;
  a.stages = stages;
  return a;
}

spec::CycleModel model(const ArraySpec& a, const Topology& t) {
  return spec::cycle_model(a, t, spec::phases_of(t, a.schedule));
}

/// 20 x 20 nodes with the left column pinned, as in the scene flag-400.
Topology flag_400() {
  return grid_topology(20, 19, true);
}

TEST(Fold, LongestRowsComeFirstAndThenLowerNumbers) {
  // A path 0 - 1 - 2, a cell 3 alone, all in one phase: rows of 4, 6, 4 and 2 taps.
  const Topology t = topology_of(4, 2, {{0, 1}, {1, 2}});
  ArraySpec a = folded(3, Stages::each);
  a.schedule = Schedule::synchronous;
  const spec::Fold fold = spec::fold_of(a, t, spec::phases_of(t, a.schedule));
  EXPECT_EQ(fold.order, (spec::Phases{{2, 3, 0, 1, 4, 5, 6, 7}}));
  ASSERT_EQ(fold.rounds[0].size(), 3u);
  EXPECT_EQ(fold.rounds[0][1].first, 3u);
  EXPECT_EQ(fold.rounds[0][1].accumulate, 4u);
  EXPECT_EQ(fold.rounds[0][2].count, 2u);
  EXPECT_EQ(fold.rounds[0][2].accumulate, 2u);
}

TEST(Fold, CyclesByHandWithAStageAnElement) {
  // Four cells alone, of one neuron: rows of one tap, one colour. The stage takes 2 + 2.
  const Topology t = topology_of(4, 1, {});
  EXPECT_EQ(model(folded(4, Stages::each), t).phase, (std::vector<std::uint64_t>{1 + 1 + 4}));
  EXPECT_EQ(model(folded(9, Stages::each), t).phase, (std::vector<std::uint64_t>{6})); // more than there are
  EXPECT_EQ(model(folded(2, Stages::each), t).phase, (std::vector<std::uint64_t>{1 + 1 + 4 + 4}));
  EXPECT_EQ(model(folded(1, Stages::each), t).sweep, 1u + 1 + 3 * 4 + 4 + 1);
  // N of a round is divided for 19 cycles while the next one waits.
  EXPECT_EQ(model(folded(2, Stages::each), t).prepare, 1u + 1 + 19 + 19);
}

TEST(Fold, CyclesByHandWithOneStage) {
  const Topology t = topology_of(4, 1, {});
  EXPECT_EQ(model(folded(4, Stages::one), t).phase, (std::vector<std::uint64_t>{1 + 1 + 3 + 4}));
  EXPECT_EQ(model(folded(3, Stages::one), t).phase, (std::vector<std::uint64_t>{1 + 1 + 3 + 0 + 4}));
  EXPECT_EQ(model(folded(1, Stages::one), t).phase, (std::vector<std::uint64_t>{1 + 4 + 4}));
  EXPECT_EQ(model(folded(3, Stages::one), t).prepare, 1u + 1 + 3 + 0 + 19);
  ArraySpec a = folded(3, Stages::one);
  a.normaliser = spec::Normaliser::divider; // N only goes into its memory
  EXPECT_EQ(model(a, t).prepare, 1u + 1 + 3 + 0 + 1);
  a.stages = Stages::each;
  EXPECT_EQ(model(a, t).prepare, 1u + 1 + 1);
  a.output = spec::Output::binary;
  EXPECT_EQ(model(a, t).prepare, 0u);
  EXPECT_EQ(model(a, t).phase, (std::vector<std::uint64_t>{1 + 1 + 2 + 2}));
}

TEST(Fold, TheFlagOf400NodesOnSixteenElements) {
  const ArraySpec preset = spec::folded_array();
  EXPECT_LE(model(preset, flag_400()).sweep, 2400u);
  // Two colours of 10 x 10 cells, 72 of them inside, 26 at an edge with 18 taps, 2 at a corner: five rounds
  // of 27 cycles and two of 18, the last of four neurons. Two colours of 10 x 9, 81 inside: six rounds of 27,
  // the last of ten neurons. The stage takes 4.
  const std::uint64_t wide = 1 + 5 * 27 + 2 * 18 + 3 + 4, narrow = 1 + 6 * 27 + 9 + 4;
  EXPECT_EQ(model(preset, flag_400()).sweep, 3 * (2 * wide + 2 * narrow) + 1);
  // The largest phase has 100 neurons: one round each.
  EXPECT_EQ(model(folded(100, Stages::each), flag_400()).sweep, 373u + 12u);
}

TEST(Fold, ARegisterMakesEveryStageACycleLonger) {
  for (int normaliser = 0; normaliser < 3; ++normaliser) {
    ArraySpec a;
    a.normaliser = static_cast<spec::Normaliser>(normaliser);
    const spec::CycleModel plain = model(a, flag_400());
    for (int registers = 0; registers <= spec::most_pipeline(a); ++registers) {
      a.pipeline = registers;
      EXPECT_EQ(model(a, flag_400()).sweep, plain.sweep + 12u * static_cast<unsigned>(registers));
      EXPECT_EQ(model(a, flag_400()).prepare, plain.prepare);
    }
  }
}

TEST(Fold, RegistersFindTheirPlacesInOrder) {
  ArraySpec a;
  std::vector<std::uint64_t> before;
  for (a.pipeline = 0; a.pipeline <= 4; ++a.pipeline) before.push_back(spec::registers_before_u(a));
  EXPECT_EQ(before, (std::vector<std::uint64_t>{0, 1, 1, 2, 2}));
  a.normaliser = spec::Normaliser::prescaled;
  before.clear();
  for (a.pipeline = 0; a.pipeline <= 3; ++a.pipeline) before.push_back(spec::registers_before_u(a));
  EXPECT_EQ(before, (std::vector<std::uint64_t>{0, 0, 1, 1}));
}

/// Against the oracle, which knows no formula: every cycle count, and when each neuron writes its V.
TEST(Fold, TheOraclesStepsAndTheFormulasAgree) {
  std::size_t folds = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const ArrayJob job = random_job(seed, 40);
    if (!spec::is_folded(job.array)) continue;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job));
    folds += 1;
    const SlowSweep slow = slow_folded_sweep(job);
    const spec::CycleModel m = model(job.array, job.topology);
    ASSERT_EQ(m.phase, slow.phases);
    ASSERT_EQ(m.prepare, slow_folded_prepare(job));
    ASSERT_EQ(spec::stage_cycles(job.array), slow_stage(job.array));
    const spec::Fold fold =
        spec::fold_of(job.array, job.topology, spec::phases_of(job.topology, job.array.schedule));
    std::uint64_t before = 0;
    for (std::size_t k = 0; k < fold.order.size(); before += m.phase[k++])
      for (const spec::Round& round : fold.rounds[k])
        for (std::size_t e = 0; e < round.count; ++e)
          ASSERT_EQ(slow.written[fold.order[k][round.first + e]],
                    before + 1 + spec::through_stage(job.array, round, e, spec::stage_cycles(job.array)));
  }
  EXPECT_GT(folds, 1500u);
}

TEST(Fold, PipelinesThatANormaliserCannotHaveAreRefused) {
  const auto fault = [](const ArraySpec& a) {
    const auto f = spec::validate(a, 9);
    return f ? f->key + ": " + f->found + ": " + f->expected : "";
  };
  ArraySpec a;
  a.pipeline = 4;
  EXPECT_EQ(fault(a), "");
  a.normaliser = spec::Normaliser::prescaled;
  EXPECT_EQ(fault(a), "array.pipeline: 4: 0 to 3 with the normaliser prescaled");
  a.output = spec::Output::binary;
  EXPECT_EQ(fault(a), "array.pipeline: 4: 0 with binary outputs");
  a.pipeline = 5;
  EXPECT_EQ(fault(a), "array.pipeline: 5: 0 to 4");
  a.pipeline = -1;
  EXPECT_EQ(fault(a), "array.pipeline: -1: 0 to 4");
  a.pipeline = 0;
  a.elements = -1;
  EXPECT_EQ(fault(a), "array.elements: -1: 0 to 4096");
}

} // namespace
} // namespace hopmesh::tests
