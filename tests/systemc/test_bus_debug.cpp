// transport_dbg: the same words as the bus, in no time, busy or not; whatever is read only stays.
#include "tests/systemc/payload.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using Words = std::vector<std::int32_t>;
constexpr auto read = tlm::TLM_READ_COMMAND, write = tlm::TLM_WRITE_COMMAND;

class Debug : public testing::Test {
 protected:
  Debug() : dut("dut", small_array(), topology) { Dut::elaborate(); }

  unsigned debug(tlm::tlm_command command, std::uint64_t address, void* data, unsigned bytes) {
    tlm::tlm_generic_payload payload;
    fill(payload, {command, address, bytes, bytes, static_cast<unsigned char*>(data), false});
    return dut.socket->transport_dbg(payload);
  }
  std::uint32_t peek(std::uint32_t address) {
    std::uint32_t word = 0;
    EXPECT_EQ(debug(read, address, &word, 4), 4u);
    return word;
  }
  unsigned poke(std::uint32_t address, std::uint32_t word) { return debug(write, address, &word, 4); }

  const spec::Topology topology = ring_topology(4);
  Dut dut;
};

TEST_F(Debug, SeesWhatTheBusSeesWithoutHoldingIt) {
  load(dut, lively_job(2, small_array(), topology));
  const std::uint32_t held = dut.read(HM_REG_BUS_CYCLES_LO);
  for (const WindowRow& w : window_rows(topology, small_array())) {
    if (w.words == 0) continue;
    Words words(w.words);
    EXPECT_EQ(debug(read, w.base, words.data(), 4 * w.words), 4 * w.words) << w.name;
    EXPECT_NE(words, Words(w.words, 0)) << w.name;
  }
  EXPECT_EQ(peek(HM_REG_BUS_CYCLES_LO), held);
  for (const RegisterRow& row : register_rows())
    EXPECT_TRUE(row.counts_transfers() || peek(row.offset) == dut.read(row.offset)) << row.name;
}

TEST_F(Debug, GivesAsManyWholeWordsAsThereAre) {
  for (const WindowRow& w : window_rows(topology, small_array())) {
    if (w.words == 0) continue;
    Words words(w.words + 8, -77);
    EXPECT_EQ(debug(read, w.base, words.data(), 4 * (w.words + 8)), 4 * w.words) << w.name;
    EXPECT_EQ(words[w.words], -77) << w.name;
    EXPECT_EQ(debug(read, w.base + 4 * (w.words - 1), words.data(), 4096), 4u) << w.name;
    const bool meets_another = w.name == "LINK"; // whose words fill a power of two
    EXPECT_EQ(debug(read, w.base + 4 * w.words, words.data(), 4), meets_another ? 4u : 0u) << w.name;
  }
  Words words(4, -77);
  EXPECT_EQ(debug(read, HM_REG_ID, words.data(), 16), 4u);
  EXPECT_EQ(words[1], -77);
  EXPECT_EQ(debug(read, dut.at(Window::BIAS), words.data(), 7), 4u);
  EXPECT_EQ(debug(read, dut.at(Window::BIAS), words.data(), 3), 0u);
  EXPECT_EQ(debug(read, dut.at(Window::BIAS) + 2, words.data(), 4), 0u);
  EXPECT_EQ(debug(tlm::TLM_IGNORE_COMMAND, dut.at(Window::BIAS), words.data(), 4), 0u);
  EXPECT_EQ(debug(read, std::uint64_t{1} << 32, words.data(), 4), 0u);
}

TEST_F(Debug, SurvivesAMissingBuffer) {
  for (auto command : {read, write})
    for (std::uint32_t address : {std::uint32_t{HM_REG_THRESHOLD}, dut.at(Window::BIAS)})
      EXPECT_EQ(debug(command, address, nullptr, 8), 0u);
}

TEST_F(Debug, LeavesAloneWhatIsReadOnly) {
  for (const RegisterRow& row : register_rows()) {
    if (row.access != Access::RO) continue;
    const std::uint32_t before = peek(row.offset);
    poke(row.offset, ~before);
    EXPECT_EQ(peek(row.offset), before) << row.name;
  }
  for (const WindowRow& w : window_rows(topology, small_array())) {
    if (w.words == 0) continue;
    const std::uint32_t before = peek(w.base);
    poke(w.base, before + 1);
    EXPECT_EQ(peek(w.base) == before, !w.writable) << w.name;
  }
}

TEST_F(Debug, StartsAndResetsNothing) {
  load(dut, lively_job(2, small_array(), topology));
  const Words before = dut.codes(Window::OUTPUT, topology.neurons());
  poke(HM_REG_CONTROL, HM_CONTROL_START | HM_CONTROL_RESET | HM_CONTROL_ABORT);
  EXPECT_EQ(peek(HM_REG_STATUS), 0u);
  EXPECT_FALSE(sc_core::sc_pending_activity());
  EXPECT_EQ(dut.codes(Window::OUTPUT, topology.neurons()), before);
}

TEST_F(Debug, WritesInTheMiddleOfARun) {
  load(dut, lively_job(2, small_array(), topology));
  dut.start(0, 2);
  dut.run_to_cycle(10);
  const auto now = sc_core::sc_time_stamp();
  EXPECT_EQ(poke(dut.at(Window::WEIGHT), 5), 4u);
  EXPECT_EQ(poke(dut.at(Window::OUTPUT) + 4, 1 << 15), 4u);
  EXPECT_EQ(peek(dut.at(Window::WEIGHT)), 5u);
  EXPECT_EQ(peek(dut.at(Window::OUTPUT) + 4), static_cast<std::uint32_t>(-(1 << 14))); // cut, then held at -1
  EXPECT_EQ(sc_core::sc_time_stamp(), now);
}

/// The high words are as the bus left them.
TEST_F(Debug, LatchesNothing) {
  dut.read(HM_REG_BUS_CYCLES_LO);
  const std::uint32_t high = peek(HM_REG_BUS_CYCLES_HI);
  peek(HM_REG_BUS_CYCLES_LO);
  EXPECT_EQ(peek(HM_REG_BUS_CYCLES_HI), high);
}

/// irq is STATUS and ENABLE, whoever wrote them.
TEST_F(Debug, TheInterruptLineFollowsItsRegisters) {
  dut.start(0, 1);
  dut.run_until_done();
  EXPECT_FALSE(dut.irq.read());
  poke(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
  sc_core::sc_start(dut.device.cells.period());
  EXPECT_TRUE(dut.irq.read());
  poke(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
  sc_core::sc_start(dut.device.cells.period());
  EXPECT_FALSE(dut.irq.read());
}

} // namespace
} // namespace hopmesh::tests
