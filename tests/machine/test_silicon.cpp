// Silicon of a square of four cells, counted by hand.
#include "sim/machine/silicon.h"

#include "rtl_model/spec/presets.h"
#include "sim/cosim/random_job.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using machine::divider_bits, machine::memory_bits, machine::multiplier_bits, machine::parts_of;

// Each cell is linked to the three others: 12 neurons of 12 taps, and so 144 weights. Sums lie within 12 +
// 256, so that s has 10 bits before its point, and 15 + 14 behind it; N has 9 and 15.
class Silicon : public testing::Test {
 protected:
  const spec::Topology square = cosim::grid_topology(2, 2, true);
  spec::ArraySpec array = spec::guarded_array();

  void fold(int elements, spec::Stages stages) { array.elements = elements, array.stages = stages; }
};

TEST_F(Silicon, OfAnArrayThatIsNotFolded) {
  const machine::Parts parts = parts_of(array, square);
  EXPECT_EQ(parts.accumulators, 12u);
  EXPECT_EQ(parts.stages, 12u);
  const machine::MemoryBits bits = memory_bits(array, square);
  EXPECT_EQ(bits.weights, 144u * 16);
  EXPECT_EQ(bits.biases, 12u * 24);
  EXPECT_EQ(bits.states, 12u * 24);
  EXPECT_EQ(bits.links, 12u * 16);
  EXPECT_EQ(bits.norms, 12u * 24);
  EXPECT_EQ(bits.reciprocals, 12u * (18 + 5)); // lengths of N from 0 to 24 take 5 bits
  EXPECT_EQ(bits.sums, 12u * 39);
  EXPECT_EQ(bits.total(), 4104u);
  EXPECT_EQ(multiplier_bits(array, square).sums, 12u * 16 * 16);
  EXPECT_EQ(multiplier_bits(array, square).outputs, 12u * 24 * 18);
  EXPECT_EQ(multiplier_bits(array, square).normalisers, 12u * 39 * 18);
  EXPECT_EQ(multiplier_bits(array, square).total(), 16680u);
  EXPECT_EQ(divider_bits(array, square), 12u * 24); // a bit of the reciprocal a cycle
}

TEST_F(Silicon, LanesAreMultipliersOfTheSums) {
  array.lanes = 5;
  EXPECT_EQ(parts_of(array, square).multipliers, 60u);
  EXPECT_EQ(multiplier_bits(array, square).sums, 60u * 16 * 16);
  EXPECT_EQ(multiplier_bits(array, square).outputs, 12u * 24 * 18);
  EXPECT_EQ(memory_bits(array, square).total(), 4104u);
}

// Every element reads links from a memory of its own; reciprocals are those of all neurons.
TEST_F(Silicon, OfAFoldedArray) {
  fold(2, spec::Stages::one);
  const machine::MemoryBits bits = memory_bits(array, square);
  EXPECT_EQ(bits.weights, 144u * 16);
  EXPECT_EQ(bits.links, 2u * 12 * 16);
  EXPECT_EQ(bits.norms, 2u * 24);
  EXPECT_EQ(bits.reciprocals, 12u * 23);
  EXPECT_EQ(bits.sums, 2u * 2 * 39); // with what they hold for the stage
  EXPECT_EQ(multiplier_bits(array, square).total(), 2u * 16 * 16 + 24 * 18 + 39 * 18);
  EXPECT_EQ(divider_bits(array, square), 18u * 24); // all bits at once
  fold(2, spec::Stages::each);
  EXPECT_EQ(memory_bits(array, square).sums, 2u * 39);
  EXPECT_EQ(multiplier_bits(array, square).total(), 2u * (16 * 16 + 24 * 18 + 39 * 18));
  EXPECT_EQ(divider_bits(array, square), 2u * 24);
  array.schedule = spec::Schedule::synchronous;
  EXPECT_EQ(memory_bits(array, square).links, 2u * 2 * 12 * 16);
  fold(0, spec::Stages::each);
  EXPECT_EQ(memory_bits(array, square).links, 12u * 16) << "registers of cells change together";
}

TEST_F(Silicon, ADividerKeepsNAndMultipliesOnlyRU) {
  array = spec::descent_array();
  EXPECT_EQ(memory_bits(array, square).norms, 12u * 24);
  EXPECT_EQ(memory_bits(array, square).reciprocals, 0u);
  EXPECT_EQ(multiplier_bits(array, square).total(), 12u * (16 * 16 + 16 * 16));
  EXPECT_EQ(divider_bits(array, square), 12u * 24);
  fold(3, spec::Stages::one);
  EXPECT_EQ(memory_bits(array, square).norms, (3u + 12) * 24); // where it is summed, and where it stays
  EXPECT_EQ(divider_bits(array, square), 15u * 24);            // 14 places of the drive, and the unit
}

TEST_F(Silicon, WithoutANormThereIsNothingToDivide) {
  for (const bool binary : {true, false}) {
    array = binary ? spec::guarded_array() : spec::prescaled_array();
    if (binary) array.output = spec::Output::binary;
    EXPECT_EQ(memory_bits(array, square).norms, 0u);
    EXPECT_EQ(memory_bits(array, square).reciprocals, 0u);
    EXPECT_EQ(multiplier_bits(array, square).total(), 12u * (16 * 16 + (binary ? 0 : 24 * 18)));
    EXPECT_EQ(divider_bits(array, square), 0u);
  }
}

TEST_F(Silicon, MomentumKeepsYAndATableAndMultipliesMByAChange) {
  array.output = spec::Output::momentum, array.schedule = spec::Schedule::synchronous;
  array.momentum_entries = 64;
  EXPECT_EQ(memory_bits(array, square).states, 2u * 12 * 24);
  EXPECT_EQ(memory_bits(array, square).links, 12u * 16);
  EXPECT_EQ(memory_bits(array, square).momentum, 64u * 16);
  EXPECT_EQ(multiplier_bits(array, square).outputs, 12u * 25 * 16);
  fold(2, spec::Stages::one);
  EXPECT_EQ(memory_bits(array, square).links, 2u * 2 * 2 * 12 * 16)
      << "two elements, two banks, links of V and of Y";
  EXPECT_EQ(multiplier_bits(array, square).outputs, 25u * 16);
}

TEST_F(Silicon, AProjectedStageAddsAndDividesByOneWeight) {
  array.output = spec::Output::projected;
  EXPECT_EQ(multiplier_bits(array, square).outputs, 0u);
  EXPECT_EQ(memory_bits(array, square).norms,
            12u * 16); // magnitudes of 16 bits, up to that of the least code
  array.normaliser = spec::Normaliser::divider;
  EXPECT_EQ(divider_bits(array, square), 12u * 16);
  fold(3, spec::Stages::one);
  EXPECT_EQ(divider_bits(array, square), 18u * 16); // 16 places of the drive, 1 and 2
}

TEST_F(Silicon, AnAccumulatorOfItsOwnLeavesNAsItIs) {
  array.exact_accumulator = false;
  array.formats.accumulator = {30, 9, spec::Rounding::trn, spec::Overflow::sat};
  EXPECT_EQ(memory_bits(array, square).sums, 12u * 30);
  EXPECT_EQ(memory_bits(array, square).norms, 12u * 24);
  EXPECT_EQ(multiplier_bits(array, square).normalisers, 12u * 30 * 18);
}

} // namespace
} // namespace hopmesh::tests
