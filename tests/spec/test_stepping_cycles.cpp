// Cycles of the stages that step further, by hand on small networks, and of the table of m.
#include "rtl_model/spec/cycles.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::ArraySpec;
using spec::Topology;

TEST(SteppingCycles, ProjectedOutputsByHand) {
  // Two linked cells of one neuron: 2 taps, two colours. 18 drive bits, 16 of them behind the point.
  const Topology t = topology_of(2, 1, {{0, 1}});
  ArraySpec a;
  a.output = spec::Output::projected;
  const auto model = [&] { return spec::cycle_model(a, t, spec::phases_of(t, a.schedule)); };
  EXPECT_EQ(model().sweep, 2u * (2 + 2 + 1) + 1); // V changes with its step
  EXPECT_EQ(model().prepare, 2u + 18 + 1);        // the row is walked for w_ii alone
  a.pipeline = 2;
  EXPECT_EQ(model().sweep, 2u * (2 + 2 + 1 + 2) + 1);
  EXPECT_EQ(spec::drive_cycles(a), 4u); // each in front of u
  EXPECT_EQ(spec::change_cycles(a), 5u);
  EXPECT_EQ(spec::stage_cycles(a), 5u);
  a.pipeline = 0;
  a.normaliser = spec::Normaliser::divider;
  EXPECT_EQ(model().sweep, 2u * (2 + 19 + 1) + 1); // sixteen places, the unit, the two, round
  EXPECT_EQ(model().prepare, 2u);
}

TEST(SteppingCycles, MomentumByHand) {
  const Topology t = topology_of(2, 1, {{0, 1}});
  ArraySpec a;
  a.output = spec::Output::momentum;
  a.schedule = spec::Schedule::synchronous;
  const auto model = [&] { return spec::cycle_model(a, t, spec::phases_of(t, a.schedule)); };
  EXPECT_EQ(model().sweep, 2u + 2 + 2 + 1); // a phase
  EXPECT_EQ(model().run(10), 1u + 21 + 70);
  const std::uint64_t drive[] = {2, 3, 3, 4}, change[] = {3, 4, 5, 6};
  for (int registers = 0; registers <= 3; ++registers) {
    a.pipeline = registers;
    EXPECT_EQ(spec::drive_cycles(a), drive[registers]);
    EXPECT_EQ(spec::change_cycles(a), change[registers]);
    EXPECT_EQ(spec::stage_cycles(a), change[registers] + 1);
  }
  a.pipeline = 0;
  a.normaliser = spec::Normaliser::divider;
  EXPECT_EQ(model().sweep, 2u + 18 + 2 + 1);
}

TEST(SteppingCycles, AResetEmptiesTheTableToo) {
  const Topology t = grid_topology(4, 4, true); // rows of at most 27 taps, 48 neurons
  ArraySpec a;
  EXPECT_EQ(spec::reset_cycles(a, t), 27u);
  a.output = spec::Output::momentum;
  a.schedule = spec::Schedule::synchronous;
  EXPECT_EQ(spec::reset_cycles(a, t), 256u);
  a.momentum_entries = 26;
  EXPECT_EQ(spec::reset_cycles(a, t), 27u);
  a.elements = 48;
  EXPECT_EQ(spec::reset_cycles(a, t), 48u);
  a.momentum_entries = 49;
  EXPECT_EQ(spec::reset_cycles(a, t), 49u);
}

} // namespace
} // namespace hopmesh::tests
