// What the driver asks of an array before it trusts it.
#include "tests/firmware/driver_fixture.h"

namespace hopmesh::tests {
namespace {

TEST_F(DriverTest, OpenLearnsFormatsFromTheCapabilities) {
  FakeArray array;
  array.normaliser = HM_NORMALISER_RECIPROCAL;
  array.weight = {12, 3, spec::Rounding::rnd_conv, spec::Overflow::sat_sym};
  array.bias = {20, 5, spec::Rounding::trn, spec::Overflow::wrap};
  expect_open(array);
  EXPECT_EQ(open(), HM_OK);
  EXPECT_EQ(driver.normaliser, array.normaliser);
  const hm_format weight = driver.weight, bias = driver.bias;
  EXPECT_EQ(weight.width, 12);
  EXPECT_EQ(weight.integer_bits, 3);
  EXPECT_EQ(weight.rounding, HM_RND_CONV);
  EXPECT_EQ(weight.overflow, HM_SAT_SYM);
  EXPECT_EQ(bias.width, 20);
  EXPECT_EQ(bias.rounding, HM_TRN);
  EXPECT_EQ(bias.overflow, HM_WRAP);
  EXPECT_EQ(driver.state.width, 16);
}

/// The driver takes format words apart by itself; here they are what spec puts together.
TEST_F(DriverTest, OpenTakesEveryModeApart) {
  for (std::size_t q = 0; q < spec::rounding_names.size(); ++q)
    for (std::size_t o = 0; o < spec::overflow_names.size(); ++o) {
      FakeArray array;
      array.state = {static_cast<int>(4 + 7 * o), static_cast<int>(1 + o), static_cast<spec::Rounding>(q),
                     static_cast<spec::Overflow>(o)};
      expect_open(array);
      ASSERT_EQ(open(), HM_OK);
      EXPECT_EQ(driver.state.width, array.state.width);
      EXPECT_EQ(driver.state.integer_bits, array.state.integer_bits);
      EXPECT_EQ(driver.state.rounding, static_cast<int>(q));
      EXPECT_EQ(driver.state.overflow, static_cast<int>(o));
    }
}

TEST_F(DriverTest, OpenReadsLongWindowsInPiecesOfTheBuffer) {
  buffer.resize(3); // FIRST_LINK has 4 words, LINK 4
  expect_open({});
  EXPECT_EQ(open(), HM_OK);
}

TEST_F(DriverTest, OpenRefusesAnotherDevice) {
  bus.expect_read(HM_REG_ID, HM_ID_VALUE ^ 1u);
  EXPECT_EQ(open(), HM_ERROR_ID);
}

TEST_F(DriverTest, OpenRefusesAnotherVersion) {
  bus.expect_read(HM_REG_ID, HM_ID_VALUE);
  bus.expect_read(HM_REG_VERSION, HM_VERSION_VALUE + 0x10000u);
  EXPECT_EQ(open(), HM_ERROR_ID);
}

TEST_F(DriverTest, OpenRefusesABufferWithoutRoom) {
  buffer.clear();
  EXPECT_EQ(open(), HM_ERROR_SPACE);
}

/// Each way in which an array can stand behind another mesh: too many cells, other neurons, other links.
class OtherMesh : public DriverTest, public testing::WithParamInterface<int> {};

TEST_P(OtherMesh, IsRefused) {
  const int stage = GetParam();
  const hm_mesh& m = mesh.mesh;
  const std::uint32_t links = m.first_link[m.cells];
  bus.expect_read(HM_REG_ID, HM_ID_VALUE);
  bus.expect_read(HM_REG_VERSION, HM_VERSION_VALUE);
  bus.expect_read(HM_REG_CAP_CELLS, m.cells + (stage == 0));
  if (stage > 0) bus.expect_read(HM_REG_CAP_NEURONS_PER_CELL, m.components + (stage == 1));
  if (stage > 1) bus.expect_read(HM_REG_CAP_LINK_WORDS, links + 2 * (stage == 2));
  std::vector<std::uint32_t> first(m.first_link, m.first_link + m.cells + 1),
      link(m.link_to, m.link_to + links);
  if (stage == 3) first[1] += 1;
  if (stage == 4) link.back() = 2;
  if (stage > 2) bus.expect_read_burst(HM_WINDOW_FIRST_LINK, first);
  if (stage > 3) bus.expect_read_burst(HM_WINDOW_LINK, link);
  EXPECT_EQ(open(), HM_ERROR_MESH);
}

INSTANTIATE_TEST_SUITE_P(EachDifference, OtherMesh, testing::Range(0, 5));

TEST_F(DriverTest, OpenPassesOnEveryErrorOfTheBus) {
  std::size_t accesses = 1;
  for (std::size_t k = 0; k < accesses; ++k) {
    const int platform_error = -100 - static_cast<int>(k);
    expect_open({});
    accesses = bus.outstanding();
    bus.fail_at(k, platform_error);
    EXPECT_EQ(open(), platform_error) << "access " << k;
    ASSERT_EQ(bus.outstanding(), 0u) << "access " << k;
  }
  EXPECT_EQ(accesses, 13u);
}

} // namespace
} // namespace hopmesh::tests
