// Rest by the largest sum, of every output stage, by phase and by clock, unfolded and folded: who counts,
// when a run ends, and what the registers tell.
#include "rtl_model/spec/array_rules.h"
#include "tests/systemc/every_way.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::Output;

/// Cells alone, one neuron each: w_ii = -1 (less a place), so that a step halves nothing but ends at once
/// with `projected`; what they have left is what they began with.
class LargestSumOf : public testing::TestWithParam<int> {};

TEST_P(LargestSumOf, NeuronsThatMayStillMove) {
  spec::ArraySpec array = spec::descent_array();
  array.output = static_cast<Output>(GetParam());
  array.momentum_entries = 1;
  if (array.output == Output::momentum) array.schedule = spec::Schedule::synchronous;
  const std::int32_t one = 16384;
  for (const auto& dut : every_way(array, topology_of(3, 1, {}))) {
    // s in 2^-29: a bias of b is b * 2^14. Neuron 0 is held at 1, neuron 1 at -1, neuron 2 is free.
    dut->put_codes(Window::WEIGHT, {0, 0, 0});
    dut->put_codes(Window::BIAS, {30000, -20000, 77});
    dut->put_codes(Window::OUTPUT, {one, -one, 0});
    dut->write(HM_REG_STOP, HM_MASK_STOP_BY_SUM);
    dut->start(1u << 30, 1); // by change, this would end as converged
    dut->run_until_done();
    EXPECT_EQ(dut->read(HM_REG_LARGEST_SUM_LO), 77u << 14);
    EXPECT_EQ(dut->read(HM_REG_LARGEST_SUM_HI), 0u);
    EXPECT_FALSE(dut->read(HM_REG_STATUS) & HM_STATUS_CONVERGED);
    dut->put_codes(Window::OUTPUT, {one, -one, one}); // all held
    dut->start(0, 9);
    dut->run_until_done();
    EXPECT_EQ(dut->read(HM_REG_LARGEST_SUM_LO), 0u);
    EXPECT_EQ(dut->read(HM_REG_SWEEPS), 1u);
    EXPECT_TRUE(dut->read(HM_REG_STATUS) & HM_STATUS_CONVERGED);
    dut->write(HM_REG_STOP, 0);
    dut->put_codes(Window::OUTPUT, {0, 0, 0});
    dut->start(0, 1);
    dut->run_until_done();
    EXPECT_EQ(dut->read(HM_REG_LARGEST_SUM_LO), 0u); // nothing is compared
  }
}

std::string output_name(const testing::TestParamInfo<int>& info) {
  return std::string(spec::output_names[static_cast<std::size_t>(info.param)]);
}
INSTANTIATE_TEST_SUITE_P(EveryOutput, LargestSumOf, testing::Range(0, 4), output_name);

/// With guard bits a neuron counts as held from where its link shows the bound.
TEST(LargestSum, LooksAtBoundsAsLinksShowThem) {
  const spec::ArraySpec array = spec::guarded_array(); // 22 places, of which links show 14
  for (const auto& dut : every_way(array, topology_of(1, 1, {}))) {
    dut->put_codes(Window::BIAS, {1000});
    dut->write(HM_REG_STOP, HM_MASK_STOP_BY_SUM);
    const std::int32_t one = 1 << 22;
    for (const auto& [V, counts] : {std::pair(one - 128, false), {one - 129, true}, {-one, true}}) {
      dut->put_codes(Window::OUTPUT, {V});
      dut->start(0, 1);
      dut->run_until_done();
      EXPECT_EQ(dut->read(HM_REG_LARGEST_SUM_LO) != 0, counts) << V;
    }
  }
}

/// A single neuron under the paper's stage: |s| falls sweep by sweep, and the run ends with the first sweep
/// that is at most the floor, or the share of the first.
TEST(LargestSum, EndsARunAtTheFloorOrTheShare) {
  const spec::ArraySpec array = spec::descent_array();
  const auto duts = every_way(array, topology_of(1, 1, {}));
  std::vector<std::uint64_t> sums; // of each sweep, one run each
  const auto run = [&](Dut& dut, std::uint32_t sweeps, std::uint32_t share, std::uint64_t floor) {
    dut.put_codes(Window::WEIGHT, {-20000});
    dut.put_codes(Window::BIAS, {9000});
    dut.put_codes(Window::OUTPUT, {0});
    dut.write(HM_REG_STOP, 1 | share << HM_SHIFT_STOP_SHARE);
    dut.write(HM_REG_SUM_THRESHOLD_LO, static_cast<std::uint32_t>(floor));
    dut.write(HM_REG_SUM_THRESHOLD_HI, static_cast<std::uint32_t>(floor >> 32));
    dut.start(0, sweeps);
    dut.run_until_done();
    const std::uint64_t low = dut.read(HM_REG_LARGEST_SUM_LO);
    return low | std::uint64_t{dut.read(HM_REG_LARGEST_SUM_HI)} << 32;
  };
  for (std::uint32_t n = 1; n <= 8; ++n) sums.push_back(run(*duts[0], n, 0, 0));
  EXPECT_EQ(sums[0], 9000u << 14); // V = 0
  for (std::size_t n = 1; n < sums.size(); ++n) ASSERT_LT(sums[n], sums[n - 1]);
  const auto swept = [&](Dut& dut) { return dut.read(HM_REG_SWEEPS); };
  for (const auto& dut : duts) {
    run(*dut, 99, 0, sums[4]); // equal is small enough ...
    EXPECT_EQ(swept(*dut), 5u);
    EXPECT_TRUE(dut->read(HM_REG_STATUS) & HM_STATUS_CONVERGED);
    run(*dut, 99, 0, sums[4] - 1); // ... and one more is not
    EXPECT_EQ(swept(*dut), 6u);
    run(*dut, 99, 0, UINT64_MAX);
    EXPECT_EQ(swept(*dut), 1u);
    run(*dut, 3, 0, sums[4]); // the limit of sweeps still holds
    EXPECT_EQ(swept(*dut), 3u);
    EXPECT_FALSE(dut->read(HM_REG_STATUS) & HM_STATUS_CONVERGED);
    for (std::uint32_t share : {1u, 2u, 3u}) {
      std::uint32_t expected = 1;
      while (sums[expected - 1] > sums[0] >> share) ++expected;
      run(*dut, 99, share, 0);
      EXPECT_EQ(swept(*dut), expected) << share;
      run(*dut, 99, share, sums[1]); // the larger of both
      EXPECT_EQ(swept(*dut), 2u) << share;
    }
  }
}

/// Taken over with START: what is written while it runs is for the next run.
TEST(LargestSum, TheRuleIsThatOfTheStart) {
  const ArrayJob job = lively_job(3, small_array(), ring_topology(4));
  Dut dut("dut", job.array, job.topology);
  load(dut, job);
  dut.start(0, 4);
  dut.write(HM_REG_STOP, 1);
  dut.write(HM_REG_SUM_THRESHOLD_HI, ~0u);
  dut.run_until_done();
  EXPECT_EQ(dut.read(HM_REG_SWEEPS), 4u);
  dut.start(0, 4);
  dut.run_until_done();
  EXPECT_EQ(dut.read(HM_REG_SWEEPS), 1u);
  EXPECT_NE(dut.read(HM_REG_LARGEST_SUM_LO), 0u);
}

/// 62 bits of accumulator: the high word is kept with its low one.
TEST(LargestSum, HasTwoWords) {
  spec::ArraySpec array = spec::descent_array();
  array.formats.weight = {32, 2, spec::Rounding::rnd, spec::Overflow::sat};
  array.formats.bias = {32, 2, spec::Rounding::rnd, spec::Overflow::sat};
  for (auto* f : {&array.formats.state, &array.formats.link}) f->width = 29; // 27 places: s has 57
  const spec::Topology alone = topology_of(1, 1, {});
  ASSERT_FALSE(spec::validate(array, 1));
  Dut dut("dut", array, alone);
  dut.put_codes(Window::BIAS, {-0x12345678});
  dut.write(HM_REG_STOP, 1);
  dut.start(0, 1);
  dut.run_until_done();
  const std::uint64_t wanted = std::uint64_t{0x12345678} << 27;
  EXPECT_EQ(dut.read(HM_REG_LARGEST_SUM_HI), 0u); // no low word was read
  EXPECT_EQ(dut.read(HM_REG_LARGEST_SUM_LO), static_cast<std::uint32_t>(wanted));
  EXPECT_EQ(dut.read(HM_REG_LARGEST_SUM_HI), static_cast<std::uint32_t>(wanted >> 32));
}

} // namespace
} // namespace hopmesh::tests
