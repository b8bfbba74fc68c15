// The capability words against the register table: none is missing, none is another register's.
#include "rtl_model/spec/capabilities.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace hopmesh::tests {
namespace {

using namespace spec;

TEST(Capabilities, TellEveryRegisterOfThatNameOnce) {
  std::map<std::uint32_t, int> told;
  for (const RegisterWord& r : capability_words(ArraySpec{}, Topology{3, {0, 0}, {}}, 3)) told[r.offset] += 1;
#define HM_X(name, offset, access, reset, meaning)                                                           \
  EXPECT_EQ(told[offset], std::string(#name).rfind("CAP_", 0) == 0 ? 1 : 0) << #name;
  HM_REGISTERS(HM_X)
#undef HM_X
}

TEST(Capabilities, TellOmegaOnlyWhereItCounts) {
  ArraySpec a;
  const auto told = [&a] {
    for (const RegisterWord& r : capability_words(a, Topology{3, {0, 0}, {}}, 3))
      if (r.offset == HM_REG_CAP_RELAXATION) return r.word;
    return UINT32_MAX;
  };
  a.relaxation = 17;
  EXPECT_EQ(told(), 0u);
  a.output = Output::projected;
  EXPECT_EQ(told(), 17u);
}

TEST(Capabilities, PackStopBitByBit) {
  EXPECT_EQ(stop_word({}), 0u);
  EXPECT_EQ(stop_word({true, 0, 99}), 1u);
  EXPECT_EQ(stop_word({true, 63, 0}), 0x3F01u);
  EXPECT_EQ(stop_word({false, 13, 0}), 0x0D00u);
}

TEST(MemoryMap, OnlyAMomentumArrayHasATable) {
  const Topology t{1, {0, 0}, {}};
  ArraySpec a;
  EXPECT_EQ(memory_map(a, t)[Window::MOMENTUM].words(), 0u);
  a.output = Output::momentum;
  a.momentum_entries = 5;
  EXPECT_EQ(memory_map(a, t)[Window::MOMENTUM].words(), 5u);
  EXPECT_GT(memory_map(a, t)[Window::MOMENTUM].offset, memory_map(a, t)[Window::WEIGHT].offset);
  a.packing = true;
  EXPECT_EQ(memory_map(a, t)[Window::MOMENTUM].words(), 3u);
  EXPECT_EQ(memory_map(a, t)[Window::MOMENTUM].code_bits(), 16);
}

TEST(Capabilities, PackAFormatByteByByte) {
  EXPECT_EQ(format_word({24, 9, Rounding::rnd_conv, Overflow::wrap}), 0x03040918u);
  EXPECT_EQ(format_word({32, 2, Rounding::trn_zero, Overflow::sat_sym}), 0x02060220u);
}

} // namespace
} // namespace hopmesh::tests
