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

/// Version 1.1 had its windows at places of its own: nothing more is asked of it.
TEST_F(DriverTest, OpenRefusesAnotherMajorVersionAndTellsWhich) {
  for (std::uint32_t other : {0x00010001u, 0x00010000u, 0x00030000u, 0u}) {
    bus.expect_read(HM_REG_ID, HM_ID_VALUE);
    bus.expect_read(HM_REG_VERSION, other);
    EXPECT_EQ(open(), HM_ERROR_VERSION);
    EXPECT_EQ(driver.version, other);
    EXPECT_EQ(bus.outstanding(), 0u);
  }
}

/// A minor version only adds.
TEST_F(DriverTest, OpenTakesAnotherMinorVersion) {
  version = HM_VERSION_VALUE + 7;
  expect_open({});
  EXPECT_EQ(open(), HM_OK);
  EXPECT_EQ(driver.version, version);
}

/// The drivers of version 1 compared the whole word with theirs.
TEST_F(DriverTest, DriversOfVersionOneRefuseThisOne) {
  EXPECT_NE(HM_VERSION_VALUE, 0x00010001u);
  EXPECT_EQ(HM_VERSION_VALUE, 0x00020001u);
}

TEST_F(DriverTest, OpenRefusesAPackingThatIsNone) {
  for (std::uint32_t codes : {0u, 3u, 8u, 255u}) {
    FakeArray array;
    array.of_weight = codes;
    expect_open(array);
    bus.drop(7); // from CAP_WINDOW_WEIGHT on
    EXPECT_EQ(open(), HM_ERROR_ID) << codes;
    EXPECT_EQ(bus.outstanding(), 0u);
  }
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
  if (stage > 2) bus.expect_read(HM_REG_CAP_WINDOW_FIRST_LINK, 0x7000);
  if (stage > 2) bus.expect_read_burst(0x7000, first);
  if (stage > 3) bus.expect_read(HM_REG_CAP_WINDOW_LINK, 0x9000);
  if (stage > 3) bus.expect_read_burst(0x9000, link);
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
  EXPECT_EQ(accesses, 19u);
}

} // namespace
} // namespace hopmesh::tests
