// The smallest job that still differs: rows stay right while cells and links go, and nothing more can go.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "sim/cosim/shrink.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

/// Weight from neuron q of cell b to neuron p of cell a.
std::int32_t weight_between(const ArrayJob& job, std::size_t a, int p, std::size_t b, int q) {
  return job.weight[weight_word(job.topology, a, p, b, q)];
}

std::size_t nonzero(const std::vector<std::int32_t>& codes) {
  return codes.size() - static_cast<std::size_t>(std::count(codes.begin(), codes.end(), 0));
}

ArrayJob job_on_grid() {
  Dice dice(5);
  return random_codes(dice, *spec::preset("descent"), grid_topology(4, 5, true));
}

TEST(Shrink, ACellLessLeavesTheOthersTheirWeights) {
  const ArrayJob job = job_on_grid(), less = without_cells(job, 7, 2);
  ASSERT_EQ(less.topology.cells(), 18u);
  ASSERT_EQ(less.weight.size(), less.topology.weight_words());
  const auto old_number = [](std::uint32_t c) { return c < 7 ? c : c + 2; };
  for (std::uint32_t c = 0; c < 18; ++c)
    for (int p = 0; p < 3; ++p) {
      EXPECT_EQ(less.bias[3 * c + static_cast<std::uint32_t>(p)],
                job.bias[3 * old_number(c) + static_cast<std::uint32_t>(p)]);
      EXPECT_EQ(weight_between(less, c, p, c, 1), weight_between(job, old_number(c), p, old_number(c), 1));
      for (std::size_t k = less.topology.first_link[c]; k < less.topology.first_link[c + 1]; ++k) {
        const std::uint32_t other = less.topology.link_to[k];
        EXPECT_EQ(weight_between(less, c, p, other, 2),
                  weight_between(job, old_number(c), p, old_number(other), 2));
      }
    }
}

TEST(Shrink, ALinkLessIsGoneOnBothSides) {
  const ArrayJob job = job_on_grid(), less = without_link(job, 6, 7);
  EXPECT_EQ(less.topology.links(), job.topology.links() - 1);
  EXPECT_EQ(less.topology.degree(6), job.topology.degree(6) - 1);
  EXPECT_EQ(less.topology.degree(7), job.topology.degree(7) - 1);
  EXPECT_EQ(weight_between(less, 6, 0, 5, 1), weight_between(job, 6, 0, 5, 1));
  EXPECT_EQ(weight_between(less, 6, 2, 12, 0), weight_between(job, 6, 2, 12, 0));
}

TEST(Shrink, TwoNeuronsACellAreThoseOfTheOther) {
  const ArrayJob job = job_on_grid(), less = without_component(job, 1);
  EXPECT_EQ(less.topology.neurons_per_cell, 2);
  EXPECT_EQ(less.start[2 * 9 + 1], job.start[3 * 9 + 2]);
  EXPECT_EQ(weight_between(less, 6, 1, 7, 0), weight_between(job, 6, 2, 7, 0));
}

// A level that is wrong where a weight of exactly 12 or more meets a cell of two or more links.
bool differs(const ArrayJob& job) {
  for (std::uint32_t c = 0; c < job.topology.cells(); ++c)
    for (int p = 0; p < job.topology.neurons_per_cell; ++p)
      if (job.topology.degree(c) >= 2 && weight_between(job, c, p, c, 0) >= 12) return true;
  return false;
}

TEST(Shrink, LeavesWhatTheFaultNeedsAndNothingElse) {
  int shrunk = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const ArrayJob job = random_job(seed);
    if (!differs(job)) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const ArrayJob small = shrink(job, differs);
    shrunk += 1;
    EXPECT_TRUE(differs(small));
    EXPECT_FALSE(spec::validate(small.array, small.topology.most_taps()));
    EXPECT_EQ(small.topology.cells(), 3u);
    EXPECT_EQ(small.topology.links(), 2u);
    bool own = false; // where the weight is not a neuron's own, it takes two neurons to have it
    for (std::uint32_t c = 0; c < 3; ++c) own |= weight_between(small, c, 0, c, 0) >= 12;
    EXPECT_EQ(small.topology.neurons_per_cell, own ? 1 : 2);
    EXPECT_EQ(nonzero(small.weight), 1u);
    EXPECT_LT(*std::max_element(small.weight.begin(), small.weight.end()), 24);
    EXPECT_EQ(nonzero(small.bias) + nonzero(small.start), 0u);
    EXPECT_EQ(small.max_sweeps, 1u);
    EXPECT_EQ(small.threshold, 0u);
    EXPECT_EQ(small.array.lanes, 1);
    EXPECT_EQ(small.array.bus_bits, 32);
    EXPECT_EQ(small.array.elements, 0);
    EXPECT_EQ(small.array.stages, spec::Stages::each);
    EXPECT_EQ(small.array.pipeline, 0);
  }
  EXPECT_GT(shrunk, 10);
}

TEST(Shrink, StopsAfterSoManyTrials) {
  int trials = 0;
  const ArrayJob job = job_on_grid();
  shrink(
      job,
      [&](const ArrayJob&) {
        trials += 1;
        return false;
      },
      17);
  EXPECT_EQ(trials, 17);
}

} // namespace
} // namespace hopmesh::tests
