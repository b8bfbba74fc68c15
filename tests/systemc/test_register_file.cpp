// The registers as the table says them: resets, rights, every bit, no aliases, nothing in between.
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

class Registers : public testing::Test {
 protected:
  Registers() : dut("dut", small_array(), ring_topology(4)) {}

  /// Everything but the counter of transfers.
  std::vector<std::uint32_t> all() {
    std::vector<std::uint32_t> words;
    for (const RegisterRow& row : rows)
      if (!row.counts_transfers()) words.push_back(dut.read(row.offset));
    return words;
  }

  const std::vector<RegisterRow> rows = register_rows();
  Dut dut;
};

TEST_F(Registers, OffsetsAreWordsOfOnePageAndStandOnce) {
  std::set<std::uint32_t> offsets;
  for (const RegisterRow& row : rows) {
    EXPECT_EQ(row.offset % 4, 0u) << row.name;
    EXPECT_LT(row.offset, 0x1000u) << row.name;
    EXPECT_TRUE(offsets.insert(row.offset).second) << row.name;
  }
  EXPECT_EQ(rows.size(), 50u);
}

TEST_F(Registers, HoldTheirResetsBeforeAnythingIsWritten) {
  for (const RegisterRow& row : rows) {
    if (row.capability() || row.counts_transfers()) continue;
    EXPECT_EQ(dut.read(row.offset), row.access == Access::WO ? 0 : row.reset) << row.name;
  }
}

TEST_F(Registers, ReadOnlyOnesRefuseWritesAndKeepTheirValue) {
  for (const RegisterRow& row : rows) {
    if (row.access != Access::RO) continue;
    const std::uint32_t before = dut.read(row.offset);
    for (std::uint32_t word : {0u, ~0u, ~before, 1u})
      EXPECT_EQ(dut.write(row.offset, word), tlm::TLM_COMMAND_ERROR_RESPONSE) << row.name;
    if (row.counts_transfers()) continue;
    EXPECT_EQ(dut.read(row.offset), before) << row.name;
  }
}

/// Bits of IRQ_ENABLE and STOP that mean anything; of the others all do.
std::uint32_t bits_of(const RegisterRow& row) {
  return row.name == "IRQ_ENABLE" ? 3 : row.name == "STOP" ? 0x3F01 : ~0u;
}

TEST_F(Registers, EveryBitOfAFieldStoresByItselfAndOthersReadZero) {
  for (const RegisterRow& row : rows) {
    if (row.access != Access::RW) continue;
    for (int bit = 0; bit < 32; ++bit)
      for (std::uint32_t word : {1u << bit, ~(1u << bit)}) {
        EXPECT_EQ(dut.write(row.offset, word), tlm::TLM_OK_RESPONSE);
        EXPECT_EQ(dut.read(row.offset), word & bits_of(row)) << row.name << " bit " << bit;
      }
  }
}

TEST_F(Registers, WriteOnlyOnesReadZero) {
  std::size_t seen = 0;
  for (const RegisterRow& row : rows) {
    if (row.access != Access::WO) continue;
    ++seen;
    EXPECT_EQ(dut.write(row.offset, ~std::uint32_t{HM_CONTROL_START | HM_CONTROL_RESET}),
              tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(dut.read(row.offset), 0u) << row.name;
  }
  EXPECT_EQ(seen, 2u); // CONTROL, IRQ_TEST
}

TEST_F(Registers, ControlBitsThatMeanNothingDoNothing) {
  const auto before = all();
  EXPECT_EQ(dut.write(HM_REG_CONTROL, 0xFFFFFFF8), tlm::TLM_OK_RESPONSE);
  EXPECT_EQ(all(), before);
}

TEST_F(Registers, AWriteTouchesNoOtherRegister) {
  for (const RegisterRow& row : rows) {
    if (row.access != Access::RW) continue;
    const auto before = all();
    const std::uint32_t word = 0xA5A50000u ^ row.offset;
    dut.write(row.offset, word);
    auto expected = before;
    std::size_t k = 0;
    for (const RegisterRow& other : rows) {
      if (other.counts_transfers()) continue;
      if (other.offset == row.offset) expected[k] = word & bits_of(row);
      ++k;
    }
    EXPECT_EQ(all(), expected) << row.name;
  }
}

TEST_F(Registers, WhatIsReservedIsNoAddress) {
  std::set<std::uint32_t> taken;
  for (const RegisterRow& row : rows) taken.insert(row.offset);
  std::size_t reserved = 0;
  for (std::uint32_t offset = 0; offset < 0x1000; offset += 4) {
    if (taken.count(offset)) continue;
    ++reserved;
    std::uint32_t word = 0xDEADBEEF;
    EXPECT_EQ(dut.transfer(tlm::TLM_READ_COMMAND, offset, &word, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
    EXPECT_EQ(word, 0xDEADBEEF);
    EXPECT_EQ(dut.write(offset, 1), tlm::TLM_ADDRESS_ERROR_RESPONSE) << std::hex << offset;
  }
  EXPECT_EQ(reserved, 0x400 - rows.size());
}

TEST_F(Registers, BackToBackReadsAndWritesSeeEachOther) {
  Dice dice(7);
  for (int k = 0; k < 1000; ++k) {
    const auto word = static_cast<std::uint32_t>(dice.bits());
    dut.write(HM_REG_THRESHOLD, word);
    dut.write(HM_REG_MAX_SWEEPS, ~word);
    ASSERT_EQ(dut.read(HM_REG_THRESHOLD), word);
    ASSERT_EQ(dut.read(HM_REG_MAX_SWEEPS), ~word);
  }
}

/// A run and a START in the middle of it: both causes stand.
TEST_F(Registers, AWrittenOneClearsACauseAndAZeroKeepsIt) {
  const auto both = [&] {
    dut.start(0, 1);
    dut.write(HM_REG_CONTROL, HM_CONTROL_START);
    dut.run_until_done();
    ASSERT_EQ(dut.read(HM_REG_IRQ_STATUS), std::uint32_t{HM_IRQ_DONE | HM_IRQ_REFUSED});
  };
  for (std::uint32_t clear = 0; clear < 4; ++clear) {
    both();
    dut.write(HM_REG_IRQ_STATUS, clear);
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), 3u & ~clear);
    dut.write(HM_REG_IRQ_STATUS, 0xFFFFFFFC);
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), 3u & ~clear);
    dut.write(HM_REG_IRQ_STATUS, ~0u);
    EXPECT_EQ(dut.read(HM_REG_IRQ_STATUS), 0u);
  }
}

TEST_F(Registers, ResetBringsBackEveryResetAndEmptiesTheMemories) {
  const auto fresh = all();
  load(dut, lively_job(3, small_array(), ring_topology(4)));
  for (const RegisterRow& row : rows)
    if (row.access == Access::RW) dut.write(row.offset, 3);
  dut.start(0, 2);
  dut.run_until_done();
  EXPECT_NE(all(), fresh);
  EXPECT_NE(dut.codes(Window::WEIGHT, 4), std::vector<std::int32_t>(4, 0));
  dut.write(HM_REG_CONTROL, HM_CONTROL_RESET);
  EXPECT_EQ(dut.read(HM_REG_BUS_CYCLES_LO), 2u); // of this very read
  dut.run_until_done();
  EXPECT_EQ(all(), fresh);
  for (const WindowRow& w : window_rows(ring_topology(4), small_array()))
    EXPECT_TRUE(!w.writable || dut.read(w.base, w.words) == std::vector<std::int32_t>(w.words, 0)) << w.name;
}

/// Fields cover no bit twice, and each register's have its own access.
TEST(Fields, FitTheirRegisters) {
  struct Field {
    std::string of;
    std::uint32_t mask;
    Access access;
  };
  std::vector<Field> fields;
#define HM_X(reg, field, lowest, width, access, meaning)                                                     \
  fields.push_back({#reg, HM_MASK_##reg##_##field, Access::access});                                         \
  EXPECT_EQ(HM_MASK_##reg##_##field,                                                                         \
            static_cast<std::uint32_t>(((std::uint64_t{1} << (width)) - 1) << (lowest)));
  HM_FIELDS(HM_X)
#undef HM_X
  std::size_t at = 0;
  for (const RegisterRow& row : register_rows()) {
    std::uint32_t covered = 0;
    const std::size_t first = at;
    for (; at < fields.size() && fields[at].of == row.name; ++at) {
      EXPECT_EQ(fields[at].mask & covered, 0u) << row.name;
      EXPECT_EQ(fields[at].access, row.access) << row.name;
      covered |= fields[at].mask;
    }
    EXPECT_GT(at, first) << row.name << " has no field, or not in its place";
    EXPECT_EQ(row.reset & ~covered, 0u) << row.name;
  }
  EXPECT_EQ(at, fields.size());
}

/// What the capabilities tell of windows, against the page's rule.
void expect_map(Dut& dut, const std::vector<WindowRow>& rows) {
  EXPECT_EQ(dut.read(HM_REG_CAP_WEIGHT_WORDS), rows[4].words);
  EXPECT_EQ(dut.read(HM_REG_CAP_MOMENTUM_WORDS), rows[5].words);
  std::uint64_t end = 0, span = 1;
  for (std::size_t w = 0; w < rows.size(); ++w) {
    EXPECT_EQ(dut.read(static_cast<std::uint32_t>(HM_REG_CAP_WINDOW_FIRST_LINK + 4 * w)), rows[w].base)
        << rows[w].name;
    end = std::max<std::uint64_t>(end, rows[w].base + 4 * rows[w].words);
  }
  while (span < end) span *= 2;
  EXPECT_EQ(dut.read(HM_REG_CAP_SPAN), span);
}

std::uint32_t packing_of(const spec::ArraySpec& array) {
  const auto share = [&](int width) { return !array.packing || width > 16 ? 1u : width > 8 ? 2u : 4u; };
  const spec::Formats& f = array.formats;
  return share(f.bias.width) + 256 * share(f.state.width) + 65536 * share(f.weight.width) +
         16777216 * (array.output == spec::Output::momentum ? share(16) : 1);
}

std::uint32_t format(const spec::NumberFormat& f) {
  return static_cast<std::uint32_t>(f.width + 256 * f.integer_bits + 65536 * static_cast<int>(f.rounding) +
                                    16777216 * static_cast<int>(f.overflow));
}

/// In every third array a stage that steps further.
spec::ArraySpec some_array(Dice& dice, std::size_t taps, std::uint64_t seed) {
  spec::ArraySpec a = random_array(dice, taps);
  if (seed % 3 != 0) return a;
  a.output = seed % 2 ? spec::Output::projected : spec::Output::momentum;
  if (a.normaliser == spec::Normaliser::prescaled) a.normaliser = spec::Normaliser::divider;
  a.schedule = seed % 2 ? spec::Schedule::coloured : spec::Schedule::synchronous;
  a.relaxation = static_cast<int>(dice.between(1, 31));
  a.momentum_entries = static_cast<int>(dice.between(1, 40));
  return a;
}

/// Capabilities of arrays made at random say what was built.
TEST(Capabilities, DescribeTheArray) {
  struct Built {
    spec::ArraySpec array;
    spec::Topology topology;
    std::unique_ptr<Dut> dut;
  };
  std::vector<Built> all;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Dice dice(seed);
    Built b;
    b.topology = random_topology(dice, 12);
    b.array = some_array(dice, b.topology.most_taps(), seed);
    b.dut = std::make_unique<Dut>(("dut" + std::to_string(seed)).c_str(), b.array, b.topology);
    all.push_back(std::move(b));
  }
  for (std::size_t k = 0; k < all.size(); ++k) {
    SCOPED_TRACE("seed " + std::to_string(k + 1));
    const auto& [array, t, dut] = all[k];
    const spec::Formats& f = array.formats;
    const auto colours = spec::phases_of(t, array.schedule).size();
    const auto expect = [&, d = dut.get()](std::uint32_t offset, std::uint64_t value) {
      EXPECT_EQ(d->read(offset), value) << std::hex << offset;
    };
    expect(HM_REG_CAP_CELLS, t.first_link.size() - 1);
    expect(HM_REG_CAP_NEURONS_PER_CELL, t.neurons_per_cell);
    expect(HM_REG_CAP_LINK_WORDS, t.link_to.size());
    expect_map(*dut, window_rows(t, array));
    expect(HM_REG_CAP_PACKING, packing_of(array));
    expect(HM_REG_CAP_PHASES, colours);
    expect(HM_REG_CAP_SCHEDULE, static_cast<std::uint32_t>(array.schedule));
    expect(HM_REG_CAP_NORMALISER, static_cast<std::uint32_t>(array.normaliser));
    expect(HM_REG_CAP_RECIPROCAL_BITS, array.reciprocal_bits);
    expect(HM_REG_CAP_LANES, array.lanes);
    expect(HM_REG_CAP_BUS_BITS, array.bus_bits);
    expect(HM_REG_CAP_FORMAT_WEIGHT, format(f.weight));
    expect(HM_REG_CAP_FORMAT_BIAS, format(f.bias));
    expect(HM_REG_CAP_FORMAT_DRIVE, format(f.drive));
    expect(HM_REG_CAP_FORMAT_STATE, format(f.state));
    expect(HM_REG_CAP_FORMAT_LINK, format(f.link));
    expect(HM_REG_CAP_FORMAT_ACCUMULATOR, format(spec::accumulator_format(array, t.most_taps())));
    expect(HM_REG_CAP_OUTPUT, static_cast<std::uint32_t>(array.output));
    expect(HM_REG_CAP_RELAXATION, array.output == spec::Output::projected ? array.relaxation : 0);
    EXPECT_EQ(dut->codes(Window::FIRST_LINK, t.first_link.size()),
              std::vector<std::int32_t>(t.first_link.begin(), t.first_link.end()));
    EXPECT_EQ(dut->codes(Window::LINK, t.link_to.size()),
              std::vector<std::int32_t>(t.link_to.begin(), t.link_to.end()));
  }
}

} // namespace
} // namespace hopmesh::tests
