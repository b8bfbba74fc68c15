// Two arrays, one of them with a fault: where they part, to the sweep, cycle, neuron and inputs.
#include "firmware/registers.h"
#include "rtl_model/spec/presets.h"
#include "sim/cosim/explain.h"
#include "tests/support/small_scenes.h"
#include "tests/support/soft_array.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

// Nodes 1, 2, 4, 5 of a 2 x 3 grid are cells 0 to 3, each linked to all others: 12 neurons of 12 taps, 4
// colours.
class Explain : public ::testing::Test {
 protected:
  std::optional<cosim::FirstDifference> difference(const Fault& fault, std::uint32_t max_sweeps = 20) {
    SoftArray healthy(array, mesh.topology()), faulty(array, mesh.topology(), fault);
    return difference(healthy, faulty, max_sweeps);
  }

  std::optional<cosim::FirstDifference> difference(SoftArray& a, SoftArray& b, std::uint32_t max_sweeps) {
    const ArrayJob job = network(max_sweeps);
    for (SoftArray* each : {&a, &b}) {
      cosim::load(cosim::BusArray(each->bus(), job.topology), job);
      each->forget_loads();
    }
    const cosim::BusArray first(a.bus(), job.topology), second(b.bus(), job.topology);
    return cosim::first_difference({first, second}, mesh, job, max_sweeps);
  }

  ArrayJob network(std::uint32_t max_sweeps) const {
    ArrayJob n{array, mesh.topology(), {}, {}, {}};
    for (std::size_t k = 0; k < mesh.topology().weight_words(); ++k)
      n.weight.push_back(-1000 +
                         static_cast<std::int32_t>(k * 37 % 911)); // negative, unlike: it moves for long
    for (std::size_t k = 0; k < 12; ++k) n.bias.push_back(static_cast<std::int32_t>(k * 53 % 301) - 150);
    n.start.assign(12, 100);
    n.max_sweeps = max_sweeps;
    return n;
  }

  /// V of all neurons after so many sweeps, by the slow array alone.
  std::vector<std::int32_t> after(std::uint32_t sweeps) const {
    const ArrayJob n = network(sweeps);
    return sweeps == 0 ? n.start : run_slow_array(n).output();
  }

  spec::ArraySpec array = *spec::preset("descent");
  levels::BuiltMesh mesh{grid_scene(2, 3)};
};

TEST_F(Explain, EqualArraysHaveNoDifference) {
  SoftArray a(array, mesh.topology()), b(array, mesh.topology());
  EXPECT_FALSE(difference(a, b, 12));
}

TEST_F(Explain, FindsSweepNodeNeuronAndCodes) {
  for (std::uint32_t sweep : {1u, 2u, 7u}) {
    const auto d = difference({sweep, 7}); // neuron 7: cell 2, which is node 4, component 1
    ASSERT_TRUE(d) << sweep;
    EXPECT_EQ(d->sweep, sweep);
    EXPECT_EQ(d->node, 4u);
    EXPECT_EQ(d->component, 1u);
    EXPECT_EQ(d->before_raw, after(sweep - 1)[7]);
    EXPECT_EQ(d->raw[0], after(sweep)[7]);
    EXPECT_EQ(d->raw[1], after(sweep)[7] ^ 1);
    EXPECT_EQ(d->bias_raw, network(1).bias[7]);
  }
}

TEST_F(Explain, TheCycleIsTheOneInWhichTheNeuronPublished) {
  // A phase: 12 taps on one lane, 14 + 2 of the divider, 2 of the output: 30. Prepare 12. Sweep 12 * 30 + 1 =
  // 361.
  for (std::uint32_t neuron = 0; neuron < 12; ++neuron) {
    const auto d = difference({3, neuron});
    ASSERT_TRUE(d);
    // Cells are all joined: cell c has colour c, so neuron i fires in phase i.
    EXPECT_EQ(d->cycle, 1 + 12 + 2 * 361 + (neuron + 1) * 30 - 1) << neuron;
  }
}

TEST_F(Explain, OfSeveralDifferencesTheEarliestFires) {
  SoftArray a(array, mesh.topology(), Fault{4, 9}), b(array, mesh.topology(), Fault{4, 5});
  const auto d = difference(a, b, 20);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->node, 2u); // neuron 5: cell 1
  EXPECT_EQ(d->component, 2u);
  EXPECT_EQ(d->raw[0] ^ d->raw[1], 1);
}

TEST_F(Explain, InputsAreTheRowAndWhatItReadThen) {
  const auto d = difference({2, 4}); // cell 1 (node 2), component 1; it fires in phase 4
  ASSERT_TRUE(d);
  ASSERT_EQ(d->inputs.size(), 12u);
  const auto before = after(1), now = after(2);
  const std::size_t cell_of_tap[] = {1, 0, 2, 3}, node_of_cell[] = {1, 2, 4, 5};
  const std::size_t row = mesh.topology().row_offset(1, 1);
  std::int64_t s = static_cast<std::int64_t>(d->bias_raw) << 14; // in units of a product
  for (std::size_t tap = 0; tap < 12; ++tap) {
    const std::size_t cell = cell_of_tap[tap / 3], neuron = 3 * cell + tap % 3;
    EXPECT_EQ(d->inputs[tap].node, node_of_cell[cell]);
    EXPECT_EQ(d->inputs[tap].component, tap % 3);
    EXPECT_EQ(d->inputs[tap].weight_raw, network(1).weight[row + tap]);
    EXPECT_EQ(d->inputs[tap].output_raw, neuron < 4 ? now[neuron] : before[neuron]) << tap;
    s += static_cast<std::int64_t>(d->inputs[tap].weight_raw) * d->inputs[tap].output_raw;
  }
  EXPECT_EQ(d->raw[0] > d->before_raw, s > 0); // a reader can follow the move by hand
}

TEST_F(Explain, AFaultBehindTheLastSweepIsNotSeen) {
  EXPECT_FALSE(difference({9, 3}, 8));
  EXPECT_TRUE(difference({8, 3}, 8));
}

TEST_F(Explain, OrderFollowsTheSchedule) {
  array.schedule = spec::Schedule::sequential;
  EXPECT_EQ(difference({1, 0})->cycle, 1u + 12 + 30 - 1);
  array.schedule = spec::Schedule::synchronous;
  const auto d = difference({1, 11}); // one phase a sweep
  EXPECT_EQ(d->cycle, 1u + 12 + 30 - 1);
  for (const auto& input : d->inputs) EXPECT_EQ(input.output_raw, 100);
}

TEST_F(Explain, NeuronsOfAFoldPublishInCyclesOfTheirOwn) {
  // All in one phase, equal rows of 12 taps: rounds 0 to 4, 5 to 9, 10 and 11. S is 14 + 2 + 2 = 18.
  array.schedule = spec::Schedule::synchronous;
  array.elements = 5;
  const std::uint64_t each = 1 + (1 + 3 * 12); // START, prepare: N goes into its memory as it is summed
  EXPECT_EQ(difference({1, 0})->cycle, each + 12 + 18);
  EXPECT_EQ(difference({1, 4})->cycle, each + 12 + 18);
  EXPECT_EQ(difference({1, 11})->cycle, each + 12 + 2 * 18 + 18); // stages are free every 18 cycles
  array.stages = spec::Stages::one;
  const std::uint64_t one = 1 + (1 + 3 * 12 + 1 + 1);
  EXPECT_EQ(difference({1, 0})->cycle, one + 12 + 18);
  EXPECT_EQ(difference({1, 4})->cycle, one + 12 + 4 + 18);
  EXPECT_EQ(difference({1, 11})->cycle, one + 3 * 12 + 1 + 18);
}

TEST_F(Explain, AFaultThatHealsIsFoundWhereItWas) {
  const auto d = difference({2, 7, 1 << 3}, 300); // long at rest by then
  ASSERT_TRUE(d);
  EXPECT_EQ(d->sweep, 2u);
  EXPECT_EQ(d->raw[0] ^ d->raw[1], 1 << 3);
}

TEST_F(Explain, AFaultOfLongRunsAloneIsFoundByLongerAndLongerRuns) {
  Fault fault{6, 3};
  fault.of_run = true; // no run of a single sweep shows it
  const auto d = difference(fault, 20);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->sweep, 6u);
  EXPECT_EQ(d->node, 2u);
  EXPECT_EQ(d->component, 0u);
}

TEST_F(Explain, ALoadedJobReadsTheWindowsBack) {
  SoftArray port(array, mesh.topology());
  const ArrayJob wanted = network(17);
  const cosim::BusArray there(port.bus(), wanted.topology);
  cosim::load(there, wanted);
  there.run(5, 17);
  const ArrayJob found = cosim::loaded_job(port.bus(), array, mesh.topology(), wanted.start);
  EXPECT_EQ(found.weight, wanted.weight);
  EXPECT_EQ(found.bias, wanted.bias);
  EXPECT_EQ(found.start, wanted.start);
  EXPECT_EQ(found.threshold, 5u);
  EXPECT_EQ(found.max_sweeps, 17u);
}

} // namespace
} // namespace hopmesh::tests
