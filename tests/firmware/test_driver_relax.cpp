// A relaxation as the bus sees it: what is written, in which order, with which codes; and what goes wrong.
#include "tests/firmware/driver_fixture.h"

#include <limits>

namespace hopmesh::tests {
namespace {

const std::vector<std::uint32_t> some_answer{0x4000u, 0xFFFFC000u, 0x1u, 0xFFFFFFFFu, 0u, 0x2000u};
const std::vector<double> some_outputs{1, -1, 0x1p-14, -0x1p-14, 0, 0.5};

class Relax : public DriverTest {
 protected:
  void open_with(const FakeArray& a) {
    array = a;
    expect_open(array);
    ASSERT_EQ(open(), HM_OK);
  }
  int shift() const {
    double w = 0, b = 0;
    for (double x : mesh.weight) w = std::max(w, std::abs(x));
    for (double x : mesh.bias) b = std::max(b, std::abs(x));
    return std::min(room_for(w, array.weight), room_for(b, array.bias));
  }
  FakeArray array;
};

TEST_F(Relax, WritesTheNetworkStartsWaitsAndReadsBack) {
  open_with({});
  fill(0.03, 1.7);
  expect_relax(array, shift(), 1, 300, some_answer);
  EXPECT_EQ(relax(1e-4, 300), HM_OK); // floor(1e-4 * 2^14) = 1
  EXPECT_EQ(mesh.output, some_outputs);
  EXPECT_EQ(result.sweeps, 17u);
  EXPECT_EQ(result.converged, 1u);
  EXPECT_EQ(result.cycles, 0x1289ABCDEFull);
  EXPECT_EQ(driver.clipped, 0u);
}

/// Rows and buffers of odd lengths; the last word of a window is not always full.
TEST_F(Relax, PacksCodesAsTheArrayTells) {
  for (std::size_t words : {1, 2, 3, 5, 64})
    for (std::uint32_t of_weight : {1u, 2u, 4u})
      for (std::uint32_t of_output : {1u, 2u})
        for (std::uint32_t of_bias : {1u, 2u, 4u}) {
          buffer.resize(words);
          FakeArray packed;
          packed.of_weight = of_weight, packed.of_output = of_output, packed.of_bias = of_bias;
          if (of_weight == 4) packed.weight = {8, 1, spec::Rounding::rnd, spec::Overflow::sat};
          if (of_bias == 2) packed.bias = {16, 5, spec::Rounding::rnd, spec::Overflow::sat};
          if (of_bias == 4) packed.bias = {7, 5, spec::Rounding::rnd, spec::Overflow::sat};
          open_with(packed);
          fill(3, 0.7);
          expect_relax(array, shift(), 16384, 1, some_answer);
          EXPECT_EQ(relax(1, 1), HM_OK);
          EXPECT_EQ(mesh.output, some_outputs) << words << " " << of_weight << of_output << of_bias;
        }
}

/// Prescaled rows come piece by piece, and words do not end where rows do.
TEST_F(Relax, PacksPrescaledRowsAcrossTheirEnds) {
  for (std::size_t words : {1, 2, 64}) {
    buffer.resize(words);
    FakeArray prescaled;
    prescaled.normaliser = HM_NORMALISER_PRESCALED;
    prescaled.weight = prescaled.bias = {8, 1, spec::Rounding::rnd, spec::Overflow::sat};
    prescaled.of_weight = prescaled.of_bias = 4;
    open_with(prescaled);
    fill(0, 0);
    mesh.weight[0] = 3, mesh.weight[3] = -1, mesh.bias[0] = 4;
    const std::vector<double> weight = mesh.weight, bias = mesh.bias;
    mesh.weight[0] = 0.375, mesh.weight[3] = -0.125, mesh.bias[0] = 0.5;
    expect_relax(array, 0, 0, 1, some_answer);
    mesh.weight = weight, mesh.bias = bias;
    EXPECT_EQ(relax(0, 1), HM_OK);
  }
}

TEST_F(Relax, UsesNoMoreThanTheBuffer) {
  for (std::size_t words : {1, 2, 5, 6, 7}) {
    buffer.resize(words);
    open_with({});
    fill(3, 0.2);
    expect_relax(array, shift(), 16384, 1, some_answer);
    EXPECT_EQ(relax(1, 1), HM_OK);
    EXPECT_EQ(mesh.output, some_outputs) << words;
  }
}

TEST_F(Relax, ThresholdIsCutToWholePlaces) {
  const std::vector<std::pair<double, std::uint32_t>> cases{
      {0, 0},     {0x1p-14, 1},     {0x1.fffp-14, 1}, {0x1p-15, 0}, {0.999 * 0x1p-14, 0},
      {2, 32768}, {1e9, 0x7FFFFFFF}};
  for (const auto& [threshold, raw] : cases) {
    open_with({});
    fill(1, 1);
    expect_relax(array, shift(), raw, 7, some_answer);
    EXPECT_EQ(relax(threshold, 7), HM_OK) << threshold;
  }
}

TEST_F(Relax, OnePowerOfTwoSoThatTheLargestWeightAndBiasFit) {
  // weight fixed<16,1>: largest 1 - 2^-15. 0.75 fits unscaled, 0.375 would fit twice, 1.0 only halved.
  EXPECT_EQ(room_for(0.75, array.weight), 0);
  EXPECT_EQ(room_for(0.375, array.weight), 1);
  EXPECT_EQ(room_for(1.0, array.weight), -1);
  EXPECT_EQ(room_for(256.0, array.bias), -1); // bias fixed<24,9>: largest 256 - 2^-15
  for (double w : {1e-9, 0.375, 0.75, 0.99999, 1.0, 40.0, 1e12})
    for (double b : {1e-9, 0.2, 255.0, 256.0, 1e12}) {
      open_with({});
      fill(w, b);
      expect_relax(array, shift(), 0, 1, some_answer);
      EXPECT_EQ(relax(0, 1), HM_OK);
      EXPECT_EQ(driver.clipped, 0u) << w << " " << b;
    }
}

TEST_F(Relax, CountsWhatRoundingMakesZero) {
  open_with({});
  fill(0, 0);
  mesh.weight[0] = 0.75, mesh.weight[1] = 1e-9, mesh.bias[0] = 1, mesh.bias[1] = 1e-12, mesh.bias[2] = 0.5;
  expect_relax(array, shift(), 0, 1, some_answer);
  EXPECT_EQ(relax(0, 1), HM_OK);
  EXPECT_EQ(driver.vanished, 2u);
  fill(0.75, 1);
  expect_relax(array, shift(), 0, 1, some_answer);
  EXPECT_EQ(relax(0, 1), HM_OK);
  EXPECT_EQ(driver.vanished, 0u) << "of the last load alone";
}

TEST_F(Relax, EmptyWeightsOrBiasesDoNotDecideTheScale) {
  for (int k = 0; k < 3; ++k) {
    open_with({});
    fill(k == 0 ? 0.3 : 0, k == 1 ? 0.3 : 0);
    const int expected = k == 0 ? 1 : k == 1 ? 9 : 0; // 0.3 * 2 < 1; 0.3 * 2^9 = 153.6 < 256
    expect_relax(array, expected, 0, 1, some_answer);
    EXPECT_EQ(relax(0, 1), HM_OK);
  }
}

TEST_F(Relax, TheScaleOfTheNetworkDoesNotReachTheArray) {
  for (int power = -900; power <= 900; power += 60) {
    open_with({});
    fill(0.6, 1.5);
    const int unscaled = shift();
    expect_relax(array, unscaled, 0, 1, some_answer);
    for (double& x : mesh.weight) x = std::ldexp(x, power);
    for (double& x : mesh.bias) x = std::ldexp(x, power);
    EXPECT_EQ(relax(0, 1), HM_OK) << "2^" << power;
  }
}

TEST_F(Relax, PrescaledRowsAreDividedByTheirSum) {
  FakeArray prescaled;
  prescaled.normaliser = HM_NORMALISER_PRESCALED;
  prescaled.weight = {16, 1, spec::Rounding::trn_zero, spec::Overflow::sat};
  prescaled.bias = {16, 1, spec::Rounding::trn_zero, spec::Overflow::sat};
  open_with(prescaled);
  fill(0, 0);
  // Row 0: weights 3, -1 and bias 4: divided by 8. Row 1: empty, stays so. Row 2: bias alone: 1, clipped to
  // the top.
  mesh.weight[0] = 3, mesh.weight[3] = -1, mesh.bias[0] = 4, mesh.bias[2] = -0.125, mesh.bias[3] = 0.125;
  const std::vector<double> weight = mesh.weight, bias = mesh.bias;
  mesh.weight[0] = 0.375, mesh.weight[3] = -0.125, mesh.bias[0] = 0.5, mesh.bias[2] = -1, mesh.bias[3] = 1;
  expect_relax(array, 0, 0, 1, some_answer);
  mesh.weight = weight, mesh.bias = bias;
  EXPECT_EQ(relax(0, 1), HM_OK);
  EXPECT_EQ(driver.clipped, 1u); // +1 has no code in fixed<16,1>; -1 has
}

/// Only the sign of s counts there: one exponent for all rows, as if there were a divider.
TEST_F(Relax, BinaryRowsAreNeverDivided) {
  FakeArray binary;
  binary.normaliser = HM_NORMALISER_PRESCALED;
  binary.output = HM_OUTPUT_BINARY;
  open_with(binary);
  EXPECT_EQ(driver.output, static_cast<std::uint32_t>(HM_OUTPUT_BINARY));
  fill(3, 5);
  expect_relax(array, shift(), 0, 1, some_answer);
  EXPECT_EQ(relax(0, 1), HM_OK);
  EXPECT_EQ(driver.clipped, 0u);
}

/// A hub with forty springs: its rows have 82 weights, more than the driver divides at a time.
class RelaxHub : public DriverTest {
 protected:
  static std::vector<PlainSpring> spokes() {
    std::vector<PlainSpring> springs;
    for (std::uint32_t k = 1; k <= 40; ++k) springs.push_back({0, k, 1, 1});
    return springs;
  }
  RelaxHub() : DriverTest(spokes(), std::vector<bool>(41, false)) {}
};

TEST_F(RelaxHub, LongPrescaledRowsAreDividedToTheEnd) {
  for (std::size_t words : {7, 64, 4096}) {
    buffer.resize(words);
    FakeArray array;
    array.normaliser = HM_NORMALISER_PRESCALED;
    expect_open(array);
    ASSERT_EQ(open(), HM_OK);
    fill(0.9, 0.4);
    const std::vector<double> weight = mesh.weight, bias = mesh.bias;
    for (std::uint32_t c = 0; c < mesh.mesh.cells; ++c)
      for (std::uint32_t p = 0; p < 2; ++p) {
        const std::uint32_t first = hm_row_offset(&mesh.mesh, c, p), taps = hm_row_length(&mesh.mesh, c);
        double norm = std::abs(bias[2 * c + p]);
        for (std::uint32_t k = 0; k < taps; ++k) norm += std::abs(weight[first + k]);
        for (std::uint32_t k = 0; k < taps; ++k) mesh.weight[first + k] /= norm;
        mesh.bias[2 * c + p] /= norm;
      }
    for (double& v : mesh.output) v = 0.25;
    expect_relax(array, 0, 0, 1, std::vector<std::uint32_t>(mesh.neurons(), 0));
    mesh.weight = weight, mesh.bias = bias;
    EXPECT_EQ(relax(0, 1), HM_OK) << words;
  }
}

TEST_F(Relax, RefusesWhatIsNotFiniteBeforeTouchingTheBus) {
  open_with({});
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()})
    for (std::vector<double>* values : {&mesh.weight, &mesh.bias, &mesh.output})
      for (std::size_t at : {std::size_t{0}, values->size() - 1}) {
        fill(1, 1);
        (*values)[at] = bad;
        EXPECT_EQ(relax(1e-3, 10), HM_ERROR_NUMBER);
      }
}

TEST_F(Relax, LeavesARunningArrayAlone) {
  open_with({});
  fill(1, 1);
  const std::vector<double> before = mesh.output;
  bus.expect_read(HM_REG_STATUS, HM_STATUS_BUSY);
  EXPECT_EQ(relax(1e-3, 10), HM_ERROR_BUSY);
  EXPECT_EQ(mesh.output, before);
}

TEST_F(Relax, PassesOnEveryErrorOfTheBusAndKeepsTheOutputs) {
  std::size_t accesses = 1;
  for (std::size_t k = 0; k < accesses; ++k) {
    open_with({});
    fill(0.03, 1.7);
    const std::vector<double> before = mesh.output;
    expect_relax(array, shift(), 1, 300, some_answer);
    accesses = bus.outstanding();
    const int platform_error = k % 2 ? HM_ERROR_STOPPED : -100 - static_cast<int>(k);
    bus.fail_at(k, platform_error);
    EXPECT_EQ(relax(1e-4, 300), platform_error) << "access " << k;
    EXPECT_EQ(mesh.output, before) << "access " << k;
    ASSERT_EQ(bus.outstanding(), 0u) << "access " << k;
  }
  EXPECT_EQ(accesses, 15u);
}

TEST_F(Relax, PassesOnAFailureInTheMiddleOfReadingBack) {
  buffer.resize(4); // six outputs come in two bursts
  open_with({});
  fill(0.03, 1.7);
  expect_relax(array, shift(), 1, 300, some_answer);
  bus.fail_at(bus.outstanding() - 1, HM_ERROR_BUS);
  EXPECT_EQ(relax(1e-4, 300), HM_ERROR_BUS);
}

} // namespace
} // namespace hopmesh::tests
