// Runs that are cut into pieces or that went too far: stopped and gone on, sweeps that follow each other and
// must go back to the one that ended the run, threads in any number. All leave what a plain run leaves.
#include "tests/engine/engine_bench.h"

#include <set>
#include <thread>

namespace hopmesh::tests {
namespace {

using engine::Engine;
using engine::Options;

/// A mesh of several chunks, on an array for the kernels, that moves for many sweeps.
ArrayJob lively_job(std::uint64_t seed, spec::Schedule schedule, const spec::Topology& topology) {
  Dice dice(seed);
  ArrayJob job;
  do {
    job = random_codes(
        dice, random_fast_array(dice, topology, static_cast<spec::Normaliser>(1 + dice.below(2))), topology);
  } while (job.array.schedule != schedule || job.array.formats.state.width < 12);
  job.threshold = 0;
  job.max_sweeps = 14;
  return job;
}

spec::Extremes extremes_of_plain_run(const ArrayJob& job) {
  Engine e(job.array, job.topology, {1, "generic", 1});
  load(e, job);
  e.run(job.threshold, job.max_sweeps);
  return e.extremes();
}

class EngineRuns : public testing::TestWithParam<int> {
 protected:
  std::uint64_t seed() const { return 500000 + static_cast<std::uint64_t>(GetParam()); }
  spec::Schedule schedule() const { return static_cast<spec::Schedule>(GetParam() % 3); }
  spec::Topology topology() const {
    return grid_topology(23, 19, GetParam() % 2 == 0, GetParam() % 4 ? 3 : 2);
  }
};

/// For each sweep a threshold that ends the run there, and nothing after it may show.
TEST_P(EngineRuns, ThatFollowEachOtherEndWherePlainOnesDo) {
  ArrayJob job = lively_job(seed(), schedule(), topology());
  SCOPED_TRACE("seed " + std::to_string(seed()) + ": " + describe(job));
  const ArrayResult whole = run_slow_array(job, Keep::every_sweep);
  const std::vector<std::uint32_t> changes = changes_of(job, whole);
  ASSERT_EQ(changes.back(), whole.largest_change);
  std::set<std::uint32_t> ends;
  for (std::uint32_t threshold : changes) {
    job.threshold = threshold;
    std::uint32_t sweeps = 1;
    while (changes[sweeps - 1] > threshold) ++sweeps;
    if (!ends.insert(sweeps).second) continue;
    ArrayResult expected{
        {whole.history[sweeps - 1]}, sweeps, true, changes[sweeps - 1], slow_cycles(job, sweeps)};
    const spec::Extremes swings = extremes_of_plain_run(job);
    for (std::size_t followed : {2u, 3u, 7u}) {
      const Options options{1, kernels_here()[(sweeps + followed) % kernels_here().size()], followed};
      SCOPED_TRACE(text(options) + ", to end after sweep " + std::to_string(sweeps));
      Engine e(job.array, job.topology, options);
      expect_run(e, job, expected);
      EXPECT_TRUE(e.extremes() == swings); // of the sweeps that count, not of those taken back
    }
  }
  EXPECT_GT(ends.size(), 3u); // in the middle of sevens, threes and pairs
}

// The length of the last run tells the next one where to look up: right, too early, too late.
TEST_P(EngineRuns, DoNotDependOnTheLengthOfTheRunBefore) {
  const ArrayJob job = lively_job(seed(), schedule(), topology());
  SCOPED_TRACE("seed " + std::to_string(seed()) + ": " + describe(job));
  const ArrayResult whole = run_slow_array(job, Keep::every_sweep);
  const std::vector<std::uint32_t> changes = changes_of(job, whole);
  std::vector<std::uint32_t> thresholds(changes.rbegin(), changes.rend());
  thresholds.insert(thresholds.end(), changes.begin(), changes.end());
  Engine e(job.array, job.topology, {1, "auto", 4});
  std::set<std::uint32_t> lengths;
  for (const std::uint32_t threshold : thresholds) {
    load(e, job);
    const std::uint32_t sweeps = e.run(threshold, job.max_sweeps).sweeps;
    EXPECT_LE(changes[sweeps - 1], threshold);
    for (std::uint32_t before = 0; before + 1 < sweeps; ++before) EXPECT_GT(changes[before], threshold);
    EXPECT_EQ(outputs(e), whole.history[sweeps - 1]);
    lengths.insert(sweeps);
  }
  EXPECT_GT(lengths.size(), 3u);
}

TEST_P(EngineRuns, AreTheSameWithTwoAndThreeThreadsAndMore) {
  ArrayJob job = lively_job(seed(), schedule(), topology());
  job.max_sweeps = 4;
  SCOPED_TRACE("seed " + std::to_string(seed()) + ": " + describe(job));
  const ArrayResult expected = run_slow_array(job);
  const spec::Extremes swings = extremes_of_plain_run(job);
  std::vector<Options> ways{{8, "auto", 1}};
  for (const std::string& kernel : kernels_here()) ways.insert(ways.end(), {{2, kernel, 1}, {3, kernel, 1}});
  ways.push_back({2, "auto", 3}); // of several threads, to follow each other changes only the layout
  for (const Options& options : ways) {
    SCOPED_TRACE(text(options));
    Engine e(job.array, job.topology, options);
    EXPECT_EQ(e.threads(), options.threads);
    expect_run(e, job, expected);
    EXPECT_TRUE(e.extremes() == swings);
  }
}

TEST_P(EngineRuns, StoppedAfterEverySweepGoOnAsIfNothingWas) {
  const ArrayJob job = lively_job(seed(), schedule(), topology());
  SCOPED_TRACE("seed " + std::to_string(seed()) + ": " + describe(job));
  const ArrayResult expected = run_slow_array(job, Keep::every_sweep);
  const std::atomic<bool> stop{true};
  for (const Options& options : {Options{1, "auto", 1}, Options{2, "generic", 1}, Options{1, "auto", 3}}) {
    SCOPED_TRACE(text(options));
    Engine e(job.array, job.topology, options);
    load(e, job);
    e.begin_run(job.threshold, job.max_sweeps, job.rule);
    std::size_t pieces = 1;
    for (; !e.advance(stop); ++pieces) {
      ASSERT_LT(e.result().sweeps, expected.sweeps);
      EXPECT_EQ(outputs(e), expected.history[e.result().sweeps - 1]);
      EXPECT_FALSE(e.result().converged);
    }
    EXPECT_GE(pieces * options.followed, expected.sweeps);
    EXPECT_GT(pieces, 3u);
    expect_result(e, expected);
    EXPECT_TRUE(e.extremes() == extremes_of_plain_run(job));
  }
}

TEST_P(EngineRuns, StoppedFromAnotherThreadGoOn) {
  ArrayJob job = lively_job(seed(), schedule(), topology());
  SCOPED_TRACE("seed " + std::to_string(seed()) + ": " + describe(job));
  const ArrayResult expected = run_slow_array(job);
  for (std::size_t threads : {1u, 2u}) {
    Engine e(job.array, job.topology, {threads, "auto", 1});
    load(e, job);
    std::atomic<bool> stop{false}, over{false};
    std::thread nuisance([&] {
      while (!over) {
        stop = !stop;
        std::this_thread::yield();
      }
    });
    e.begin_run(job.threshold, job.max_sweeps, job.rule);
    while (!e.advance(stop)) {
    }
    over = true;
    nuisance.join();
    expect_result(e, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, EngineRuns, testing::Range(0, 6));

TEST(EngineRun, WithoutASweepTakesOne) {
  ArrayJob job = random_job(600000);
  job.max_sweeps = 0;
  Engine e(job.array, job.topology);
  expect_run(e, job, run_slow_array(job));
  EXPECT_EQ(e.result().sweeps, 1u);
}

} // namespace
} // namespace hopmesh::tests
