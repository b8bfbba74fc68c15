// The capability words against the register table: none is missing, none is another register's.
#include "rtl_model/spec/capabilities.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace hopmesh::spec {
namespace {

TEST(Capabilities, TellEveryRegisterOfThatNameOnce) {
  std::map<std::uint32_t, int> told;
  for (const RegisterWord& r : capability_words(ArraySpec{}, Topology{3, {0, 0}, {}}, 3)) told[r.offset] += 1;
#define HM_X(name, offset, access, reset, meaning)                                                           \
  EXPECT_EQ(told[offset], std::string(#name).rfind("CAP_", 0) == 0 ? 1 : 0) << #name;
  HM_REGISTERS(HM_X)
#undef HM_X
}

TEST(Capabilities, PackAFormatByteByByte) {
  EXPECT_EQ(format_word({24, 9, Rounding::rnd_conv, Overflow::wrap}), 0x03040918u);
  EXPECT_EQ(format_word({32, 2, Rounding::trn_zero, Overflow::sat_sym}), 0x02060220u);
}

} // namespace
} // namespace hopmesh::spec
