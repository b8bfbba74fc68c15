// What the driver adds where an array has a table of m, or a run shall stop by the largest sum.
#include "tests/firmware/driver_fixture.h"

namespace hopmesh::tests {
namespace {

class Stages : public DriverTest {
 protected:
  void open_with(const FakeArray& a) {
    array = a;
    expect_open(array);
    ASSERT_EQ(open(), HM_OK);
    ASSERT_EQ(bus.outstanding(), 0u);
  }
  static FakeArray momentum(std::uint32_t words, std::uint32_t of_momentum) {
    FakeArray a;
    a.output = HM_OUTPUT_MOMENTUM;
    a.momentum_words = words;
    a.of_momentum = of_momentum;
    return a;
  }
  FakeArray array;
};

TEST_F(Stages, OpenFillsTheTableWithTheSequence) {
  for (std::size_t words : {1, 3, 64, 300})
    for (std::uint32_t of_momentum : {1u, 2u}) {
      buffer.resize(words);
      open_with(momentum(33, of_momentum));
    }
}

/// m_0 = 0, m_1 = 0.28..., and every one is larger than the one before: by hand for the first three.
TEST_F(Stages, TheSequenceBeginsAsThePageSays) {
  buffer.resize(3);
  array = momentum(3, 1);
  expect_open(array);
  bus.drop(2); // the table, and the interrupt
  bus.expect_write_burst(array.momentum, {0u, 9232u, 14223u});
  bus.expect_write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
  EXPECT_EQ(open(), HM_OK);
}

TEST_F(Stages, AListIsRoundedAndItsLastEntryFillsTheRest) {
  open_with(momentum(3, 2));
  const std::vector<double> m{0, 0.5, 0.75, 1};
  bus.expect_read(HM_REG_CAP_MOMENTUM_WORDS, 3);
  expect_bursts(true, array.momentum, {0x40000000u, 0x7FFF6000u, 0x7FFF7FFFu}); // 1 has no code
  EXPECT_EQ(hm_driver_put_momentum(&driver, m.data(), 4), HM_OK);
}

TEST_F(Stages, AListMustFitTheTable) {
  open_with(momentum(3, 1));
  const std::vector<double> m(4, 0.5);
  for (std::uint32_t count : {0u, 4u}) {
    bus.expect_read(HM_REG_CAP_MOMENTUM_WORDS, 3);
    EXPECT_EQ(hm_driver_put_momentum(&driver, m.data(), count), HM_ERROR_SPACE);
  }
  open_with({}); // an array without a table
  bus.expect_read(HM_REG_CAP_MOMENTUM_WORDS, 0);
  EXPECT_EQ(hm_driver_put_momentum(&driver, m.data(), 1), HM_ERROR_SPACE);
}

TEST_F(Stages, OpenPassesOnEveryErrorOfTheBus) {
  std::size_t accesses = 1;
  array = momentum(5, 2);
  for (std::size_t k = 0; k < accesses; ++k) {
    expect_open(array);
    accesses = bus.outstanding();
    bus.fail_at(k, -100);
    EXPECT_EQ(open(), -100) << "access " << k;
    ASSERT_EQ(bus.outstanding(), 0u) << "access " << k;
  }
  EXPECT_EQ(accesses, 23u);
}

// ---- stop by sum

/// relax of a network of one weight and no bias, from where outputs are; `stop` expects what it adds.
class StopBySum : public Stages {
 protected:
  /// A weight of 0.75 is loaded as 0.75 * 2^15, and the longest row has |w| = 0.75 + 0.375.
  void fill_two() {
    fill(0, 0);
    mesh.weight[0] = 0.75, mesh.weight[3] = -0.375;
  }
  void expect_load(int shift) {
    bus.expect_read(HM_REG_STATUS, HM_STATUS_DONE);
    expect_bursts(true, array.weights, codes(mesh.weight, shift, array.weight));
    expect_bursts(true, array.biases, codes(mesh.bias, shift, array.bias));
    expect_bursts(true, array.outputs, codes(mesh.output, 0, array.state));
  }
  void expect_floor(std::uint64_t floor) {
    bus.expect_read(HM_REG_CAP_FORMAT_LINK, spec::format_word(link));
    bus.expect_read(HM_REG_CAP_FORMAT_ACCUMULATOR, spec::format_word(sum));
    bus.expect_write(HM_REG_SUM_THRESHOLD_LO, static_cast<std::uint32_t>(floor));
    bus.expect_write(HM_REG_SUM_THRESHOLD_HI, static_cast<std::uint32_t>(floor >> 32));
  }
  void expect_run() {
    bus.expect_write(HM_REG_THRESHOLD, 0);
    bus.expect_write(HM_REG_MAX_SWEEPS, 9);
    bus.expect_write(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
    bus.expect_write(HM_REG_CONTROL, HM_CONTROL_START);
    bus.expect_wait();
    bus.expect_write(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
    bus.expect_read(HM_REG_STATUS, HM_STATUS_DONE | HM_STATUS_CONVERGED);
    bus.expect_read(HM_REG_SWEEPS, 4);
    bus.expect_read(HM_REG_CYCLES_LO, 99);
    bus.expect_read(HM_REG_CYCLES_HI, 0);
    expect_bursts(false, array.outputs, std::vector<std::uint32_t>(6, 0));
  }
  /// A relaxation that writes STOP.
  void expect_stop(std::uint64_t floor, std::uint32_t stop) {
    fill_two();
    expect_load(0);
    expect_floor(floor);
    bus.expect_write(HM_REG_STOP, stop);
    expect_run();
    ASSERT_EQ(relax(0, 9), HM_OK);
    ASSERT_EQ(bus.outstanding(), 0u);
  }

  spec::NumberFormat link{16, 2, spec::Rounding::rnd, spec::Overflow::sat};  // a place: 2^-14
  spec::NumberFormat sum{39, 10, spec::Rounding::trn, spec::Overflow::wrap}; // a place: 2^-29
};

// 1.125 * 2^-14 in units of 2^-29.
constexpr std::uint64_t floor_of_two = 36864;

TEST_F(StopBySum, SharesAreThePowerOfTwoAtOrBelow) {
  struct Case {
    double share;
    std::uint32_t places;
  };
  for (const Case& c : {Case{0, 0}, Case{0.5, 1}, Case{0.49, 2}, Case{0.25, 2}, Case{0x1p-13, 13},
                        Case{0x1.8p-13, 13}, Case{1e-4, 14}, Case{0x1p-63, 63}, Case{1e-30, 63}}) {
    open_with({});
    driver.stop = {1, c.share};
    expect_stop(floor_of_two, 1 | c.places << 8);
  }
}

TEST_F(StopBySum, TheFloorIsWhatAPlaceOfTheLinksIsWorth) {
  const std::vector<std::pair<int, std::uint64_t>> cases{{29, 36864}, {16, 4}, {15, 2},
                                                         {14, 1},     {13, 0}, {60, 36864ull << 31}};
  for (const auto& [fraction, floor] : cases) {
    sum.width = fraction + 2, sum.integer_bits = 2;
    open_with({});
    driver.stop = {1, 0};
    expect_stop(floor, 1);
  }
}

/// An array that nobody asks to stop so sees no transfer more; one that was asked is told when that is over.
TEST_F(StopBySum, StopIsWrittenWhenItChanges) {
  open_with({});
  driver.stop = {1, 0x1p-13};
  expect_stop(floor_of_two, 1 | 13u << 8);
  for (int again = 0; again < 2; ++again) {
    fill_two();
    expect_load(0);
    if (again == 0) expect_floor(floor_of_two);
    if (again == 1) driver.stop = {0, 0}, bus.expect_write(HM_REG_STOP, 0);
    expect_run();
    EXPECT_EQ(relax(0, 9), HM_OK);
    EXPECT_EQ(bus.outstanding(), 0u);
  }
  fill_two();
  expect_load(0);
  expect_run();
  EXPECT_EQ(relax(0, 9), HM_OK);
}

TEST_F(StopBySum, PrescaledRowsAreWorthNoMoreThanTheirShare) {
  FakeArray prescaled;
  prescaled.normaliser = HM_NORMALISER_PRESCALED;
  open_with(prescaled);
  driver.stop = {1, 0};
  fill(0, 0);
  mesh.weight[0] = 3, mesh.weight[3] = -1, mesh.bias[0] = 4; // 4 of 8
  bus.expect_read(HM_REG_STATUS, HM_STATUS_DONE);
  const std::vector<double> weight = mesh.weight, bias = mesh.bias;
  mesh.weight[0] = 0.375, mesh.weight[3] = -0.125, mesh.bias[0] = 0.5;
  expect_bursts(true, array.weights, codes(mesh.weight, 0, array.weight));
  expect_bursts(true, array.biases, codes(mesh.bias, 0, array.bias));
  expect_bursts(true, array.outputs, codes(mesh.output, 0, array.state));
  mesh.weight = weight, mesh.bias = bias;
  expect_floor(16384); // 0.5 * 2^15
  bus.expect_write(HM_REG_STOP, 1);
  expect_run();
  EXPECT_EQ(relax(0, 9), HM_OK);
}

TEST_F(StopBySum, AnArrayOfVersionTwoZeroCannot) {
  version = HM_VERSION_MAJOR << 16;
  open_with({});
  driver.stop = {1, 0x1p-13};
  fill_two();
  expect_load(0);
  EXPECT_EQ(relax(0, 9), HM_ERROR_VERSION);
}

} // namespace
} // namespace hopmesh::tests
