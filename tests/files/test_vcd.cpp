// The VCD writer, read back by a reader of its own.
#include "sim/files/vcd.h"
#include "tests/support/files.h"
#include "tests/support/vcd.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

class VcdWriter : public testing::Test {
 protected:
  Folder around;
};

TEST_F(VcdWriter, WritesScopesWidthsAndTimes) {
  files::VcdFile file(around / "w.vcd", 1000);
  file.open_scope("a");
  const auto wire = file.add("wire", 1);
  file.open_scope("b");
  const auto word = file.add("word", 8);
  const auto wide = file.add("wide", 64);
  file.close_scope();
  file.close_scope();
  file.set(word, -3);
  file.begin(5000);
  file.time(7000);
  file.set(wire, 1);
  file.set(word, -3); // no change
  file.set(wide, INT64_MIN);
  file.time(9000); // nothing happens
  file.time(11000);
  file.set(word, 127);
  file.set(word, -128);
  file.set(wide, 5);
  file.time(12000);
  file.finish();
  const Vcd vcd = read_vcd(around / "w.vcd");
  EXPECT_EQ(vcd.times, (std::vector<std::uint64_t>{7000, 11000, 12000}));
  EXPECT_EQ(vcd.signals.at("a.wire").rises(), std::vector<std::uint64_t>{7000});
  EXPECT_EQ(vcd.signals.at("a.b.word").width, 8);
  EXPECT_EQ(vcd.signals.at("a.b.word").initial, -3);
  EXPECT_EQ(vcd.signals.at("a.b.word").changes.size(), 2u);
  EXPECT_EQ(vcd.signals.at("a.b.word").last(), -128);
  EXPECT_EQ(vcd.signals.at("a.b.wide").changes.at(0).value, INT64_MIN);
  EXPECT_EQ(vcd.signals.at("a.b.wide").last(), 5);
}

TEST_F(VcdWriter, HasAShortCodeForEachOfManySignals) {
  files::VcdFile file(around / "w.vcd", 1);
  constexpr std::int64_t many = 20000; // codes of one, two and three characters
  for (std::int64_t k = 0; k < many; ++k) file.add("s" + std::to_string(k), 32);
  file.begin(0);
  file.time(1);
  for (std::int64_t k = 0; k < many; ++k) file.set(static_cast<std::size_t>(k), k);
  file.finish();
  const Vcd vcd = read_vcd(around / "w.vcd");
  ASSERT_EQ(vcd.signals.size(), static_cast<std::size_t>(many)); // the reader refuses a code that comes twice
  for (std::int64_t k : {std::int64_t{0}, std::int64_t{93}, std::int64_t{94}, std::int64_t{9000}, many - 1})
    EXPECT_EQ(vcd.signals.at("s" + std::to_string(k)).last(), k);
}

TEST_F(VcdWriter, LeavesNothingBehindUnfinished) {
  { files::VcdFile file(around / "w.vcd", 1); }
  EXPECT_TRUE(around.empty());
}

} // namespace
} // namespace hopmesh::tests
