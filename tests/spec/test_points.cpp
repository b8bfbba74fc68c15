// Places between points, held to what they mean: codes of either side that stand for one value.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/points.h"
#include "sim/cosim/random_job.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hopmesh::tests {
namespace {

using namespace spec;

/// The value of the code 1.
double last_place(const NumberFormat& f) {
  return std::ldexp(1.0, -f.fraction_bits());
}

/// The last place when a code was moved up by so many places.
double moved_up(double place, int places) {
  return std::ldexp(place, -places);
}

TEST(Points, OfTheDefaultArrayByHand) {
  // Fractions: weight 15, bias 15, link 14, so products and their exact sum 29; drive 16, state 22.
  const Points p = points_of(built_formats(ArraySpec{}, 27));
  EXPECT_EQ(p.product_up, 0);
  EXPECT_EQ(p.sum_up, 0);
  EXPECT_EQ(p.bias_down, 15 - 29);
  EXPECT_EQ(p.weight_up, 0);
  EXPECT_EQ(p.bias_up, 0);
  EXPECT_EQ(p.ratio_up, 16 + 15 - 29);
  EXPECT_EQ(p.scaled_down, 29 - 16);
  EXPECT_EQ(p.link_down, 22 - 14);
  EXPECT_EQ(p.step_down, 16 - 22); // the state is finer: nothing is lost
  EXPECT_EQ(relaxation_down, 4);
  EXPECT_EQ(momentum_down, 15);
}

TEST(Points, OfRandomArraysKeepTheValueOfACode) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    cosim::Dice dice(seed);
    const Formats f = built_formats(cosim::random_array(dice, 9), 9);
    const Points p = points_of(f);
    const double weight = last_place(f.weight), bias = last_place(f.bias), sum = last_place(f.accumulator);
    const double product = weight * last_place(f.link), norm = std::min(weight, bias);
    EXPECT_EQ(moved_up(product, p.product_up), std::min(product, bias));
    EXPECT_EQ(moved_up(sum, p.sum_up), std::min(product, bias));
    EXPECT_EQ(moved_up(sum, p.bias_down), bias);
    EXPECT_EQ(moved_up(weight, p.weight_up), norm);
    EXPECT_EQ(moved_up(bias, p.bias_up), norm);
    EXPECT_EQ(moved_up(sum / norm, p.ratio_up), last_place(f.drive));
    EXPECT_EQ(moved_up(last_place(f.drive), p.scaled_down), sum);
    EXPECT_EQ(moved_up(last_place(f.link), p.link_down), last_place(f.state));
    EXPECT_EQ(moved_up(last_place(f.state), p.step_down), last_place(f.drive));
  }
}

} // namespace
} // namespace hopmesh::tests
