// What hm_relax makes of a solver's answers.
#include "tests/support/firmware_mesh.h"

extern "C" {
#include "firmware/bus.h"
#include "firmware/relax.h"
}

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

/// Answers as told, and moves every output by one.
struct Told {
  int error;
  hm_relaxation answer;
  double threshold = 0;
  std::uint32_t max_sweeps = 0;

  static int relax(void* self, const hm_mesh* mesh, hm_network* network, double threshold,
                   std::uint32_t max_sweeps, hm_relaxation* result) {
    Told& told = *static_cast<Told*>(self);
    told.threshold = threshold, told.max_sweeps = max_sweeps;
    for (std::uint32_t k = 0; k < hm_neuron_count(mesh); ++k) network->output[k] += 1;
    *result = told.answer;
    return told.error;
  }
};

class RelaxSum : public testing::Test {
 protected:
  int relax(Told& told) {
    const hm_solver solver{&told, &Told::relax, nullptr, nullptr};
    return hm_relax(&solver, &two.mesh, &two.network, start.data(), 0.25, 9, &sum);
  }
  FirmwareMesh two{{{0, 1, 1, 1}}, {false, false}, 2};
  std::vector<double> start = std::vector<double>(4, -1);
  hm_relaxation sum{5, 1, 1000};
};

TEST_F(RelaxSum, AddsWhatItTookAndTellsWhetherTheLastOneConverged) {
  Told first{HM_OK, {3, 0, std::uint64_t{1} << 40}}, second{HM_OK, {4, 1, 2}};
  ASSERT_EQ(relax(first), HM_OK);
  EXPECT_EQ(sum.converged, 0u);
  ASSERT_EQ(relax(second), HM_OK);
  EXPECT_EQ(sum.converged, 1u);
  EXPECT_EQ(sum.sweeps, 12u);
  EXPECT_EQ(sum.cycles, (std::uint64_t{1} << 40) + 1002);
  EXPECT_EQ(second.threshold, 0.25);
  EXPECT_EQ(second.max_sweeps, 9u);
}

TEST_F(RelaxSum, KeepsWhereTheOutputsStarted) {
  two.output = {0.5, -0.5, 0.25, 0};
  Told told{HM_OK, {}};
  ASSERT_EQ(relax(told), HM_OK);
  EXPECT_EQ(start, std::vector<double>({0.5, -0.5, 0.25, 0}));
  EXPECT_EQ(two.output, std::vector<double>({1.5, 0.5, 1.25, 1}));
}

TEST_F(RelaxSum, AnErrorIsPassedOnAndNotCounted) {
  Told told{HM_ERROR_BUS, {3, 0, 7}};
  EXPECT_EQ(relax(told), HM_ERROR_BUS);
  EXPECT_EQ(sum.sweeps, 5u);
  EXPECT_EQ(sum.converged, 1u);
  EXPECT_EQ(sum.cycles, 1000u);
}

} // namespace
} // namespace hopmesh::tests
