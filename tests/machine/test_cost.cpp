// The cost model: what it learns from, how it learns, and how far off it is for arrays that it has not seen.
#include "sim/machine/cost/part_synthesis.h"
#include "sim/machine/cost/whole_cost.h"
#include "sim/machine/rtl/rtl_tables.h"

#include "rtl_model/spec/presets.h"
#include "sim/cosim/random_job.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace machine;

class Cost : public testing::Test {
 protected:
  const spec::Topology square = cosim::grid_topology(2, 2, true);
  spec::ArraySpec array = spec::guarded_array();

  void fold(int elements, spec::Stages stages) { array.elements = elements, array.stages = stages; }
  std::vector<double> features(Part part) const { return features_of(part, cost_parameters(array, square)); }
};

TEST_F(Cost, LeastSquaresFindsWeightsThatAreThere) {
  const std::vector<double> w = least_squares({{1, 0}, {1, 2}, {1, 5}, {1, 9}}, {3, 4, 5.5, 7.5});
  EXPECT_NEAR(w[0], 3, 1e-9);
  EXPECT_NEAR(w[1], 0.5, 1e-9);
}

// 10 and 40 by a single weight: (w / 10 - 1)^2 + (w / 40 - 1)^2 is least at w = (1/10 + 1/40) / (1/100 +
// 1/1600).
TEST_F(Cost, LeastSquaresWeighsErrorsByTheValue) {
  EXPECT_NEAR(least_squares({{1}, {1}}, {10, 40})[0], 0.125 / (0.01 + 0.000625), 1e-9);
}

// The free line through (1, 4) and (4, 1) would fall; with no weight below 0 it is a constant.
TEST_F(Cost, LeastSquaresHasNoWeightBelowZero) {
  const std::vector<double> w = least_squares({{1, 1}, {1, 4}}, {4, 1});
  EXPECT_GT(w[0], 0);
  EXPECT_EQ(w[1], 0);
}

// Weight and link have 16 bits, sums 39; a shared stage writes one memory of links.
TEST_F(Cost, AnElementGrowsWithItsWidths) {
  fold(2, spec::Stages::one);
  EXPECT_EQ(features(Part::element), (std::vector<double>{1, 16 * 16, 39, 32, 0}));
  fold(4, spec::Stages::each);
  EXPECT_EQ(features(Part::element)[4], 3 * 16) << "one of four links is chosen";
  array.output = spec::Output::momentum;
  EXPECT_EQ(features(Part::element)[4], 3 * 32 + 16) << "links have V and Y";
  array = spec::guarded_array();
  EXPECT_EQ(features(Part::element)[4], 11 * 16) << "no fold: one of the 12 of a row";
}

// (24 + 1) by (16 + 1) for R u, 39 by 18 for s r.
TEST_F(Cost, AStageGrowsWithItsMultipliers) {
  fold(2, spec::Stages::one);
  EXPECT_EQ(features(Part::stage)[2], 25 * 17 + 39 * 18);
  EXPECT_EQ(features(Part::stage)[4], 18 * 25) << "a subtractor a bit of the reciprocal";
  array.stages = spec::Stages::each;
  EXPECT_EQ(features(Part::stage)[4], 25) << "one that makes bits one after the other";
  array.output = spec::Output::binary;
  EXPECT_EQ(features(Part::stage)[2], 0);
}

TEST_F(Cost, PartsAreCountedByTheFold) {
  fold(3, spec::Stages::one);
  const Parameters one = cost_parameters(array, square);
  EXPECT_EQ(count_of(Part::element, one), 3);
  EXPECT_EQ(count_of(Part::stage, one), 1);
  EXPECT_EQ(count_of(Part::rest, one), 1);
  array.stages = spec::Stages::each;
  EXPECT_EQ(count_of(Part::stage, cost_parameters(array, square)), 3);
  array.elements = 0;
  EXPECT_EQ(count_of(Part::stage, cost_parameters(array, square)), 12);
}

// Twelve neurons of 12 taps on 2 elements: 12 phases of a neuron would be 12 rounds. Shapes of 4 kbit: 256
// words of 16 bits.
TEST_F(Cost, MemoriesTakeTheShapeThatNeedsTheFewestBlocks) {
  const MemoryBlocks one = memory_blocks({{"a", 1, 16, 256, false}});
  EXPECT_EQ(one.ice40_blocks, 1);
  EXPECT_EQ(one.ecp5_blocks, 1);
  EXPECT_EQ(one.bits, 4096);
  const MemoryBlocks deep = memory_blocks({{"a", 3, 16, 2048, true}});
  EXPECT_EQ(deep.ice40_blocks, 3 * 8);
  EXPECT_EQ(deep.ecp5_blocks, 3 * 2);
  EXPECT_EQ(deep.bits, 0);
  EXPECT_EQ(deep.table_bits, 3 * 32768);
  EXPECT_EQ(memory_blocks({{"a", 1, 8, 16, false}}).ice40_blocks, 0) << "so few bits take LUTs";
}

TEST_F(Cost, TablesAreThoseOfTheRtl) {
  for (const spec::Stages stages : {spec::Stages::one, spec::Stages::each}) {
    fold(3, stages);
    std::vector<MemoryShape> tables = memories_of(array, square);
    tables.erase(
        std::remove_if(tables.begin(), tables.end(), [](const MemoryShape& m) { return !m.read_only; }),
        tables.end());
    const std::vector<BitTable> made = rtl_tables(array, square, rtl_room(array, square));
    ASSERT_EQ(tables.size(), made.size());
    for (std::size_t k = 0; k < made.size(); ++k) {
      EXPECT_EQ(tables[k].width, static_cast<std::uint64_t>(made[k].width)) << made[k].name;
      EXPECT_EQ(tables[k].depth, made[k].rows) << made[k].name;
    }
  }
}

TEST_F(Cost, PointsAreReadAsTheyAreWritten) {
  const std::vector<CostPoint>& points = shipped_points();
  ASSERT_FALSE(points.empty());
  const std::vector<CostPoint> again = read_points(points_text(points));
  ASSERT_EQ(again.size(), points.size());
  EXPECT_EQ(points_text(again), points_text(points));
  EXPECT_EQ(again.front().parameters, points.front().parameters);
  EXPECT_THROW(read_points("array,use\nonly\n"), std::runtime_error);
}

// What the page promises, where the arrays that were held back are all measured.
TEST_F(Cost, TheModelIsWithinFifteenPercentOfWhatItHasNotSeen) {
  for (const Figure figure : {Figure::ecp5_lut4, Figure::ecp5_ff, Figure::um2}) {
    if (cost_model().held(figure) < 12) GTEST_SKIP() << "points.csv wants tests/campaigns/cost_points";
    EXPECT_LE(cost_model().largest_error(figure), 0.15) << all_figures[static_cast<std::size_t>(figure)].name;
  }
}

TEST_F(Cost, ReadsTheWholeOfAStat) {
  const auto cells =
      cells_of_stat("=== a ===\n\n   Number of cells:  9\n     LUT4   9\n\n=== design hierarchy ===\n\n"
                    "   Number of cells:                119\n     CCU2C                          20\n"
                    "     LUT4                           17\n\n");
  EXPECT_EQ(cells.at("LUT4"), 17);
  EXPECT_EQ(cells.at("CCU2C"), 20);
  EXPECT_EQ(cells.size(), 2u);
  EXPECT_TRUE(cells_of_stat("nothing").empty());
}

// A step that does nothing but wait costs its clocks; work costs more; memories cost by what is read.
TEST_F(Cost, EnergyIsThatOfWhatWorks) {
  fold(2, spec::Stages::one);
  CostPoint parts;
  parts.parameters = cost_parameters(array, square);
  for (PartFigures& part : parts.parts) part.fill(0);
  const auto at = [&](Part p, Figure f) -> double& {
    return parts.parts[static_cast<std::size_t>(p)][static_cast<std::size_t>(f)];
  };
  at(Part::element, Figure::idle_pj) = 3, at(Part::element, Figure::active_pj) = 5;
  Activity a;
  a.all_cycles = 100;
  EXPECT_NEAR(silicon_energy(a, parts, {}).total(), 2 * 3 * 100e-12, 1e-24);
  a.products = 10;
  EXPECT_NEAR(silicon_energy(a, parts, {0.25, 0.25}).arithmetic, 10 * 5e-12, 1e-24);
  EXPECT_NEAR(silicon_energy(a, parts, {0.5, 0.5}).arithmetic, 2 * 10 * 5e-12, 1e-24);
}

// 144 products and 12 firings a sweep, and as many for N.
TEST_F(Cost, ActivityIsCountedFromTheDescription) {
  fold(2, spec::Stages::one);
  const Activity a = activity_of(array, square, {1000, 50, 4}, 1);
  EXPECT_EQ(a.products, 5 * 144);
  EXPECT_EQ(a.firings, 5 * 12);
  EXPECT_EQ(a.all_cycles, 1050);
  // A line of the table for each of 12 taps of 12 phases: three flags, and for each element a place of 4 bits
  // and whether there is a tap.
  EXPECT_EQ(a.table_bits, 4 * 144 * (3 + 2 * 5));
  array.normaliser = spec::Normaliser::prescaled;
  EXPECT_EQ(activity_of(array, square, {1000, 50, 4}, 1).products, 4 * 144) << "the host divides";
}

// By the table an addition of 32 bits takes 0.1 pJ, a multiplication of 32 by 32 bits 3.1.
TEST_F(Cost, TheTableIsHorowitz) {
  fold(1, spec::Stages::one);
  array.formats.weight.width = array.formats.link.width = 32;
  const Parameters p = cost_parameters(array, square);
  Activity a;
  a.products = 1;
  const double sum = features_of(Part::element, p)[2];
  EXPECT_NEAR(table_energy(a, p).total(), (3.1 + sum / 32 * 0.1) * 1e-12, 1e-18);
}

} // namespace
} // namespace hopmesh::tests
