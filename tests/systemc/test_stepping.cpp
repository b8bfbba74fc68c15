// The output stage of projected and momentum arrays, module alone, against the page in plain whole numbers:
// all 8-bit states and drives in every rounding, all small quotients with either normaliser.
#include "rtl_model/spec/presets.h"
#include "rtl_model/systemc/input_accumulator.h"
#include "rtl_model/systemc/output_stage.h"
#include "tests/support/random_network.h"
#include "tests/support/stepping.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::Normaliser;
using spec::Output;
using spec::Rounding;
using systemc::OutputStage;

spec::ArraySpec stepping_array(Output output, Rounding rounding, int drive_width) {
  spec::ArraySpec a =
      output == Output::momentum ? spec::descent_momentum_array() : spec::descent_projected_array();
  a.formats.state = a.formats.link = {8, 2, rounding, spec::Overflow::wrap};
  a.formats.drive = {drive_width, 2, rounding, spec::Overflow::sat_zero}; // neither overflow mode ever acts
  return a;
}

/// Rounding, and width of the drive.
class SteppingStage : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  Rounding rounding() const { return static_cast<Rounding>(std::get<0>(GetParam())); }
  int drive_width() const { return std::get<1>(GetParam()); }
  Stepping page() const { return {drive_width() - 2, {8, 2, rounding(), spec::Overflow::wrap}}; }
  std::int64_t one() const { return std::int64_t{1} << (drive_width() - 2); }
};

TEST_P(SteppingStage, ProjectedMovesAsThePageSays) {
  const systemc::Datapath path(stepping_array(Output::projected, rounding(), drive_width()), 3, 3);
  OutputStage stage("stage", path);
  for (std::int64_t u = -2 * one(); u <= 2 * one(); ++u)
    for (std::int32_t V = -64; V <= 64; ++V) {
      stage.load(V);
      stage.find_change(u);
      const std::int64_t change = stage.publish(), wanted = page().moved(V, u);
      ASSERT_EQ(stage.state_raw(), wanted) << V << " " << u;
      ASSERT_EQ(change, wanted - V);
      ASSERT_EQ(stage.link_raw(), wanted);
      ASSERT_EQ(stage.pull_raw(), 0);
      ASSERT_EQ(stage.product_raw(), 0);
    }
}

TEST_P(SteppingStage, MomentumMovesAsThePageSays) {
  const systemc::Datapath path(stepping_array(Output::momentum, rounding(), drive_width()), 3, 3);
  OutputStage stage("stage", path);
  Dice dice(7);
  for (std::int64_t u = -one(); u <= one(); ++u)
    for (std::int32_t Y = -64; Y <= 64; Y += 2) {
      const auto V = static_cast<std::int32_t>(dice.between(-64, 64));
      const std::int64_t m = dice.one_in(3) ? dice.between(-1, 1) : dice.between(-32768, 32767);
      stage.load(V);
      EXPECT_EQ(stage.extrapolated_raw(), V);
      stage.extrapolate(Y);
      stage.find_change(u);
      const std::int64_t change = stage.publish(0, m), wanted = page().moved(Y, u);
      ASSERT_EQ(stage.state_raw(), wanted) << V << " " << Y << " " << u;
      ASSERT_EQ(change, wanted - V);
      ASSERT_EQ(stage.product_raw(), m * change);
      ASSERT_EQ(stage.extrapolated_raw(), page().ahead(wanted, change, m)) << V << " " << wanted << " " << m;
      ASSERT_EQ(stage.link_raw(), stage.extrapolated_raw());
      stage.settle();
      ASSERT_EQ(stage.extrapolated_raw(), wanted);
      ASSERT_EQ(stage.link_raw(), wanted);
    }
}

TEST_P(SteppingStage, QuotientsAreRoundedOnceAndThenLimited) {
  for (Output output : {Output::projected, Output::momentum})
    for (Normaliser normaliser : {Normaliser::divider, Normaliser::reciprocal}) {
      spec::ArraySpec a = stepping_array(output, rounding(), drive_width());
      a.normaliser = normaliser;
      a.reciprocal_bits = 9;
      const systemc::Datapath path(a, 3, 3);
      OutputStage stage("stage", path);
      const std::int64_t bound = output == Output::projected ? 2 * one() : one();
      const std::int64_t factor = output == Output::projected ? 29 : 1, sixteen = factor == 1 ? 1 : 16;
      // s counts in the place of a product, 2^-21, what divides it in 2^-15: s / n = (s_code / 64) / n_code.
      for (std::int64_t n = 1; n <= 70; ++n) {
        stage.set_norm(n);
        std::int64_t scale = 128; // r = scale / n, nine bits of it: 2^(9 - 2) times 2^B
        for (std::int64_t rest = n; rest > 0; rest /= 2) scale *= 2;
        for (std::int64_t s = -64 * 3 * n; s <= 64 * 3 * n; s += 7) {
          stage.normalise(s);
          const std::int64_t exact =
              normaliser == Normaliser::divider
                  ? textbook_quotient(factor * s * one(), sixteen * 64 * n, rounding())
                  : textbook_quotient(factor * s * (scale / n) * one(), sixteen * 64 * scale, rounding());
          ASSERT_EQ(stage.drive_raw(), std::clamp(exact, -bound, bound)) << s << " / " << n;
          ASSERT_EQ(stage.ratio_raw(), stage.drive_raw());
        }
      }
      stage.set_norm(0); // nothing divides: the sign decides
      for (std::int64_t s : {-5, 0, 1}) {
        stage.normalise(s);
        EXPECT_EQ(stage.drive_raw(), (s > 0 ? bound : s < 0 ? -bound : 0));
      }
    }
}

std::string name_of(const testing::TestParamInfo<std::tuple<int, int>>& info) {
  return std::string(spec::rounding_names[std::get<0>(info.param)]) + "_drive_" +
         std::to_string(std::get<1>(info.param));
}
INSTANTIATE_TEST_SUITE_P(EveryMode, SteppingStage,
                         testing::Combine(testing::Range(0, 7), testing::Values(4, 8, 11)), name_of);

/// A neuron is held where s pushes it to the bound from which its step goes, and nowhere else.
TEST(Held, IsANeuronAtItsBound) {
  for (const spec::ArraySpec& array :
       {spec::descent_array(), spec::descent_projected_array(), spec::descent_momentum_array()}) {
    const systemc::Datapath path(array, 3, 3);
    OutputStage stage("stage", path);
    const auto held = [&](std::int32_t at, std::int64_t sum) {
      stage.load(at);
      return stage.is_held(sum);
    };
    EXPECT_TRUE(held(16384, 1) && held(16384, 0) && held(-16384, -1) && held(-16384, 0)) << array.name;
    EXPECT_FALSE(held(16384, -1) || held(-16384, 1) || held(16383, 1) || held(0, 0)) << array.name;
    stage.load(0);
    stage.extrapolate(16384); // Y counts where there is one
    EXPECT_EQ(stage.is_held(1), array.output == Output::momentum) << array.name;
  }
}

/// What divides s: N, N without the bias, or the own tap alone.
TEST(Norm, IsWhatTheOutputStageWants) {
  for (int lanes : {1, 2, 5})
    for (Output output : {Output::modified, Output::projected, Output::momentum}) {
      spec::ArraySpec array = spec::descent_array();
      array.output = output;
      array.lanes = lanes;
      const systemc::Datapath path(array, 3, 3);
      systemc::InputAccumulator sums("sums", path, {3});
      const std::int32_t weights[] = {5, -7, 11};
      for (std::size_t t = 0; t < 3; ++t) sums.set_weight(t, weights[t]);
      sums.set_bias(-100);
      sums.set_own_tap(1);
      sums.norm_row();
      EXPECT_EQ(sums.norm_raw(), output == Output::modified ? 123 : output == Output::projected ? 7 : 23);
    }
}

} // namespace
} // namespace hopmesh::tests
