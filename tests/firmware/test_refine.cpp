// Corrections of a step's answer by its residual: how exact they are, what travels, what the box and coarse
// words do to them.
#include "tests/firmware/flown_sheet.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

/// The largest error of the first steps of the banner, by a share of the first sweep's |s|.
double largest_error(const spec::ArraySpec& array, std::uint32_t refinements) {
  FlownSheet sheet(Sheet{}, array);
  sheet.driver.stop = {1, 0x1p-13};
  sheet.motion.refinements = refinements;
  double largest = 0;
  for (int step = 0; step < 2; ++step) {
    const hm_step_result result = sheet.step();
    EXPECT_EQ(result.refinement.corrections, refinements);
    EXPECT_EQ(result.refinement.refused, 0u);
    largest = std::max(largest, sheet.error());
  }
  return largest;
}

TEST(Refine, ReachesTenDigitsWithWordsOfSixteenBits) {
  EXPECT_GT(largest_error(momentum_array(16, 24), 0), 1e-4);
  EXPECT_LT(largest_error(momentum_array(16, 24), 4), 1e-10);
}

TEST(Refine, ReachesSevenDigitsWithWordsOfTwelveBits) {
  EXPECT_GT(largest_error(momentum_array(12, 16), 0), 1e-3);
  EXPECT_LT(largest_error(momentum_array(12, 16), 5), 1e-7);
}

/// A small sheet, whatever the output stage.
Sheet small_sheet() {
  Sheet sheet;
  sheet.rows = sheet.columns = 4;
  return sheet;
}

std::uint32_t bus_cycles(FlownSheet& sheet) {
  std::uint32_t word = 0;
  EXPECT_EQ(sheet.port.read(HM_REG_BUS_CYCLES_LO, &word, 1), HM_OK);
  return word;
}

TEST(Refine, ServesEveryStageAndEveryStep) {
  for (const spec::Output output : {spec::Output::modified, spec::Output::projected, spec::Output::momentum})
    for (const hm_formulation* formulation : {&hm_backward_euler, &hm_bdf2, &hm_static}) {
      // Without inertia the paper's stage takes thousands of sweeps to come near its rest.
      if (output == spec::Output::modified && formulation == &hm_static) continue;
      spec::ArraySpec array = momentum_array(16, 24);
      array.output = output;
      if (output != spec::Output::momentum) array.schedule = spec::Schedule::coloured;
      FlownSheet sheet(small_sheet(), array);
      sheet.motion.formulation = formulation;
      sheet.motion.refinements = 6;
      sheet.motion.threshold = 1e-5;
      sheet.motion.max_sweeps = 500;
      for (int step = 0; step < 2; ++step) {
        sheet.step();
        EXPECT_LT(sheet.error(), 1e-6) << formulation->name << ", output " << static_cast<int>(output);
      }
    }
}

TEST(Refine, SendsBiasesAlone) {
  FlownSheet plain(small_sheet(), momentum_array(16, 24)), refined(small_sheet(), momentum_array(16, 24));
  refined.motion.refinements = 1;
  const std::uint32_t before = bus_cycles(plain);
  plain.step();
  const std::uint32_t loaded = bus_cycles(plain) - before;
  const std::uint32_t from = bus_cycles(refined);
  refined.step();
  const std::uint32_t correction = bus_cycles(refined) - from - loaded;
  EXPECT_GT(correction, 3 * plain.mesh.neurons()) << "bias and start out, answer in";
  EXPECT_LT(correction, 3 * plain.mesh.neurons() + 40);
}

TEST(Refine, WeightsStayForSoManySteps) {
  FlownSheet sheet(small_sheet(), momentum_array(16, 24));
  sheet.motion.refinements = 4;
  sheet.motion.reload_every = 3;
  const std::uint32_t weights = hm_weight_count(&sheet.mesh.mesh);
  for (int step = 0; step < 7; ++step) {
    const std::uint32_t before = bus_cycles(sheet);
    const hm_step_result result = sheet.step();
    const std::uint32_t others = (result.refinement.corrections + 1) * (3 * sheet.mesh.neurons() + 40);
    EXPECT_EQ(bus_cycles(sheet) - before > weights + 3 * sheet.mesh.neurons() * result.refinement.corrections,
              step % 3 == 0);
    if (step % 3) {
      EXPECT_LT(bus_cycles(sheet) - before, others);
    }
    EXPECT_LT(sheet.error(), 1e-4) << "step " << step;
  }
}

/// Eight bits are too few for springs this stiff: what a correction would add makes things worse.
TEST(Refine, KeepsTheBestWhereCorrectionsGoAstray) {
  Sheet stiff;
  stiff.weight = 50000;
  stiff.time_step = 0.002;
  FlownSheet plain(stiff, momentum_array(8, 16)), refined(stiff, momentum_array(8, 16));
  for (FlownSheet* sheet : {&plain, &refined}) sheet->driver.stop = {1, 0x1p-13};
  refined.motion.refinements = 6;
  refined.step();
  const hm_step_result result = refined.step();
  EXPECT_EQ(result.refinement.refused, 1u);
  EXPECT_LT(result.refinement.corrections, 6u);
  EXPECT_GT(result.refinement.residual, 0.01);
}

/// A static step of springs with rest lengths goes no further than the longest spring: a strong pull takes
/// outputs to their bounds. What is left of those between is nothing.
TEST(Refine, FindsTheLeastInTheBox) {
  for (const spec::Output output : {spec::Output::projected, spec::Output::momentum}) {
    spec::ArraySpec array = momentum_array(16, 24);
    array.output = output;
    if (output == spec::Output::projected) array.schedule = spec::Schedule::coloured;
    FlownSheet sheet(small_sheet(), array);
    sheet.motion.formulation = &hm_static;
    sheet.motion.refinements = 8;
    sheet.motion.threshold = 1e-5;
    sheet.motion.max_sweeps = 500;
    sheet.motion.force[0] = 2000;
    const hm_step_result result = sheet.step();
    int held = 0, between = 0;
    for (const double V : sheet.mesh.output) std::fabs(V) >= 1 ? ++held : ++between;
    EXPECT_GT(held, 0);
    EXPECT_GT(between, 0);
    EXPECT_LT(result.refinement.residual, 1e-11) << result.refinement.corrections << " corrections";
  }
}

} // namespace
} // namespace hopmesh::tests
