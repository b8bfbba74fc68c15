// What the socket answers to each kind of good and bad transfer, how long it holds the bus, and that a
// refused transfer changes nothing.
#include "tests/systemc/payload.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using Words = std::vector<std::int32_t>;

class Bus : public testing::Test {
 protected:
  Bus() : dut("dut", small_array(), topology) { buffer.fill(0x5A); }

  tlm::tlm_response_status send(Attempt a, bool null_data = false) {
    a.data = null_data ? nullptr : buffer.data();
    fill(payload, a);
    return dut.send(payload);
  }
  tlm::tlm_response_status send(tlm::tlm_command command, std::uint64_t address, unsigned length) {
    return send({command, address, length, length, nullptr, false});
  }
  /// Everything that a host can see and that does not count transfers.
  std::vector<Words> image() {
    std::vector<Words> words;
    for (const RegisterRow& row : register_rows())
      if (!row.counts_transfers()) words.push_back({static_cast<std::int32_t>(dut.read(row.offset))});
    for (const WindowRow& w : windows) words.push_back(dut.read(w.base, w.words));
    return words;
  }
  bool buffer_untouched() const {
    return std::all_of(buffer.begin(), buffer.end(), [](unsigned char c) { return c == 0x5A; });
  }

  const spec::Topology topology = ring_topology(4);
  const std::vector<WindowRow> windows = window_rows(topology, small_array());
  std::array<unsigned char, 8192> buffer{};
  tlm::tlm_generic_payload payload;
  Dut dut;
};

constexpr auto read = tlm::TLM_READ_COMMAND, write = tlm::TLM_WRITE_COMMAND;

TEST_F(Bus, OnlyWholeWordsTravel) {
  for (unsigned length : {0u, 1u, 2u, 3u, 5u, 6u, 7u, 4097u})
    for (std::uint32_t address : {std::uint32_t{HM_REG_THRESHOLD}, dut.at(Window::OUTPUT)})
      for (auto command : {read, write})
        EXPECT_EQ(send(command, address, length), tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_TRUE(buffer_untouched());
}

TEST_F(Bus, ARegisterIsOneWordLong) {
  for (const RegisterRow& row : register_rows())
    for (unsigned length : {8u, 12u, 4096u})
      EXPECT_EQ(send(read, row.offset, length), tlm::TLM_BURST_ERROR_RESPONSE) << row.name;
  EXPECT_EQ(send(write, HM_REG_THRESHOLD, 8), tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_EQ(dut.read(HM_REG_THRESHOLD), 0u);
}

TEST_F(Bus, AddressesAreMultiplesOfFour) {
  for (std::uint32_t off : {1u, 2u, 3u})
    for (std::uint32_t base :
         {0u, std::uint32_t{HM_REG_THRESHOLD}, dut.at(Window::OUTPUT), dut.at(Window::WEIGHT)})
      for (auto command : {read, write})
        EXPECT_EQ(send(command, base + off, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE) << std::hex << base + off;
}

TEST_F(Bus, ByteEnablesAreRefusedEvenIfAllAreSet) {
  EXPECT_EQ(send({read, HM_REG_ID, 4, 4, nullptr, true}), tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
  EXPECT_EQ(send({write, dut.at(Window::BIAS), 4, 4, nullptr, true}), tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
}

TEST_F(Bus, StreamingIsRefusedAndAWiderWidthIsNone) {
  for (unsigned width : {0u, 4u, 7u})
    EXPECT_EQ(send({read, dut.at(Window::OUTPUT), 8, width, nullptr, false}), tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_EQ(send({read, dut.at(Window::OUTPUT), 8, 12, nullptr, false}), tlm::TLM_OK_RESPONSE);
}

TEST_F(Bus, NoDataAndNoCommandAreErrors) {
  EXPECT_EQ(send({read, HM_REG_ID, 4, 4, nullptr, false}, true), tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_EQ(send({write, dut.at(Window::BIAS), 4, 4, nullptr, false}, true), tlm::TLM_BURST_ERROR_RESPONSE);
  EXPECT_EQ(send(tlm::TLM_IGNORE_COMMAND, HM_REG_ID, 4), tlm::TLM_COMMAND_ERROR_RESPONSE);
  EXPECT_TRUE(buffer_untouched());
}

/// Words of four cells of three neurons in a ring: 5, 8, 12, 12, 4 * 3 * 9 = 108, and none.
TEST_F(Bus, WindowsLieAtMultiplesOfTheirPowersOfTwo) {
  const std::vector<std::uint32_t> bases{0x1000, 0x1020, 0x1040, 0x1080, 0x1200, 0};
  for (std::size_t k = 0; k < windows.size(); ++k) {
    EXPECT_EQ(windows[k].base, bases[k]) << windows[k].name;
    EXPECT_EQ(dut.read(static_cast<std::uint32_t>(HM_REG_CAP_WINDOW_FIRST_LINK + 4 * k)), bases[k])
        << windows[k].name;
  }
  EXPECT_EQ(dut.read(HM_REG_CAP_SPAN), 0x2000u);
}

TEST_F(Bus, NothingAnswersOutsideTheWindows) {
  std::set<std::uint64_t> inside;
  for (const WindowRow& w : windows)
    for (std::uint64_t k = 0; k < w.words; ++k) inside.insert(w.base + 4 * k);
  EXPECT_EQ(inside.size(), 5u + 8 + 12 + 12 + 108);
  for (std::uint64_t address = 0x1000; address < 0x2800; address += 4)
    EXPECT_EQ(send(read, address, 4),
              inside.count(address) ? tlm::TLM_OK_RESPONSE : tlm::TLM_ADDRESS_ERROR_RESPONSE)
        << std::hex << address;
  for (std::uint64_t address : inside) {
    EXPECT_EQ(send(read, address + (std::uint64_t{1} << 32), 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
    EXPECT_EQ(send(read, address | std::uint64_t{1} << 63, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  }
  for (std::uint64_t address : {0x10000000u, 0x40000000u, 0x80000000u}) // where version 1 had its windows
    EXPECT_EQ(send(read, address, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(send(read, std::uint64_t{1} << 32 | HM_REG_ID, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
  EXPECT_EQ(send(read, UINT64_MAX - 3, 4), tlm::TLM_ADDRESS_ERROR_RESPONSE);
}

TEST_F(Bus, ABurstAcrossAnEndIsRefusedWhole) {
  load(dut, lively_job(1, small_array(), topology));
  const auto before = image();
  for (const WindowRow& w : windows)
    for (std::uint64_t words : {w.words + 1, w.words + 300}) {
      if (w.words == 0) continue;
      EXPECT_EQ(send(read, w.base, 4 * words), tlm::TLM_ADDRESS_ERROR_RESPONSE) << w.name;
      EXPECT_TRUE(buffer_untouched());
      EXPECT_EQ(send(write, w.base, 4 * words), tlm::TLM_ADDRESS_ERROR_RESPONSE) << w.name;
      EXPECT_EQ(send(write, w.base + 4 * (w.words - 1), 8), tlm::TLM_ADDRESS_ERROR_RESPONSE) << w.name;
    }
  EXPECT_EQ(image(), before);
}

TEST_F(Bus, TheMapOfLinksCannotBeWritten) {
  const auto before = image();
  for (const WindowRow& w : windows)
    EXPECT_EQ(send(write, w.base, 4) == tlm::TLM_COMMAND_ERROR_RESPONSE, !w.writable || w.words == 0)
        << w.name;
  EXPECT_EQ(image()[register_rows().size() - 2], before[register_rows().size() - 2]); // FIRST_LINK
  EXPECT_EQ(dut.codes(Window::LINK, topology.link_to.size()),
            Words(topology.link_to.begin(), topology.link_to.end()));
}

TEST_F(Bus, WindowsAreRefusedDuringARunAndRegistersAnswer) {
  load(dut, lively_job(1, small_array(), topology));
  const auto weights = dut.codes(Window::WEIGHT, topology.weight_words());
  dut.start(0, 3);
  dut.run_to_cycle(20);
  for (const WindowRow& w : windows) {
    if (w.words == 0) continue;
    EXPECT_EQ(send(write, w.base, 4), tlm::TLM_COMMAND_ERROR_RESPONSE) << w.name;
    EXPECT_EQ(send(read, w.base, 4), tlm::TLM_COMMAND_ERROR_RESPONSE) << w.name;
    EXPECT_EQ(send(read, w.base, 4 * w.words), tlm::TLM_COMMAND_ERROR_RESPONSE) << w.name;
  }
  EXPECT_TRUE(buffer_untouched());
  EXPECT_EQ(dut.read(HM_REG_STATUS), std::uint32_t{HM_STATUS_BUSY});
  EXPECT_EQ(dut.write(HM_REG_IRQ_ENABLE, 3), tlm::TLM_OK_RESPONSE);
  for (const RegisterRow& row : register_rows()) EXPECT_EQ(send(read, row.offset, 4), tlm::TLM_OK_RESPONSE);
  dut.run_until_done();
  EXPECT_EQ(dut.codes(Window::WEIGHT, topology.weight_words()), weights);
  EXPECT_EQ(send(write, dut.at(Window::BIAS), 4), tlm::TLM_OK_RESPONSE);
}

TEST_F(Bus, DirectMemoryIsRefused) {
  tlm::tlm_dmi dmi;
  Dut::elaborate();
  fill(payload, {read, dut.at(Window::WEIGHT), 4, 4, buffer.data(), false});
  EXPECT_FALSE(dut.socket->get_direct_mem_ptr(payload, dmi));
  EXPECT_EQ(send(read, dut.at(Window::WEIGHT), 4), tlm::TLM_OK_RESPONSE);
  EXPECT_FALSE(payload.is_dmi_allowed());
}

TEST_F(Bus, CodesAreCutToTheirFormatAndOutputsHeldAtOne) {
  const spec::Formats f = small_array().formats;
  const auto kept = [](std::uint32_t word, int width) { // two's complement of the low bits
    const std::int64_t low = word & ((std::uint64_t{1} << width) - 1);
    return static_cast<std::int32_t>(low >> (width - 1) ? low - (std::int64_t{1} << width) : low);
  };
  Dice dice(11);
  for (int k = 0; k < 300; ++k) {
    const auto word = static_cast<std::uint32_t>(dice.bits());
    for (Window w : {Window::WEIGHT, Window::BIAS, Window::OUTPUT}) dut.write(dut.at(w) + 4, word);
    EXPECT_EQ(dut.codes(Window::WEIGHT, 2)[1], kept(word, f.weight.width)) << std::hex << word;
    EXPECT_EQ(dut.codes(Window::BIAS, 2)[1], kept(word, f.bias.width)) << std::hex << word;
    const std::int32_t one = 1 << 14, v = kept(word, f.state.width);
    EXPECT_EQ(dut.codes(Window::OUTPUT, 2)[1], std::clamp(v, -one, one)) << std::hex << word;
  }
}

/// 1 + ceil(32 n / bus) cycles, in the delay and in the counter; an answer that refuses, two.
class BusWidth : public testing::TestWithParam<int> {};

TEST_P(BusWidth, HoldsTheBusForTheAddressAndTheBeats) {
  spec::ArraySpec array = small_array(GetParam());
  array.clock_mhz = 250;
  Dut dut("dut", array, ring_topology(12));
  std::uint64_t sum = 0;
  for (unsigned words = 1; words <= 40; ++words) {
    Words data(words);
    unsigned beats = 0;
    for (int bits = static_cast<int>(32 * words); bits > 0; bits -= GetParam()) ++beats;
    ASSERT_EQ(dut.transfer(words % 2 ? write : read, dut.at(Window::WEIGHT), data.data(), 4 * words),
              tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(dut.last_delay, sc_core::sc_time(4.0 * (1 + beats), sc_core::SC_NS)) << words;
    sum += 1 + beats;
    EXPECT_EQ(dut.write(HM_REG_ID, 0), tlm::TLM_COMMAND_ERROR_RESPONSE);
    EXPECT_EQ(dut.last_delay, sc_core::sc_time(8.0, sc_core::SC_NS));
    sum += 2 + 2; // and of the counter's own reading
    EXPECT_EQ(dut.read(HM_REG_BUS_CYCLES_LO), sum);
  }
  sum += 2;
  EXPECT_EQ(dut.read(HM_REG_BUS_CYCLES_HI), 0u);
}

/// Every way to be refused takes the bus alike.
TEST_P(BusWidth, IsHeldForTwoCyclesByEveryRefusal) {
  Dut dut("dut", small_array(GetParam()), ring_topology(4));
  Dut::elaborate();
  unsigned char data[16] = {};
  const std::vector<Attempt> refused{{tlm::TLM_IGNORE_COMMAND, HM_REG_ID, 4, 4, data, false},
                                     {read, HM_REG_ID, 8, 8, data, false},
                                     {read, HM_REG_ID, 4, 4, nullptr, false},
                                     {read, HM_REG_ID, 4, 4, data, true},
                                     {read, 0xC8, 4, 4, data, false},
                                     {read, dut.at(Window::BIAS) + 2, 16, 16, data, false},
                                     {write, dut.at(Window::LINK), 16, 16, data, false}};
  std::uint32_t held = dut.read(HM_REG_BUS_CYCLES_LO);
  for (const Attempt& a : refused) {
    tlm::tlm_generic_payload payload;
    fill(payload, a);
    EXPECT_NE(dut.send(payload), tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(dut.last_delay, dut.device.cells.period() * 2);
    held += 4; // the refusal, and this read
    EXPECT_EQ(dut.read(HM_REG_BUS_CYCLES_LO), held);
  }
}

TEST_P(BusWidth, AddsToTheDelayItIsGiven) {
  Dut dut("dut", small_array(GetParam()), ring_topology(4));
  Dut::elaborate();
  std::uint32_t word = 0;
  tlm::tlm_generic_payload payload;
  fill(payload, {read, HM_REG_ID, 4, 4, reinterpret_cast<unsigned char*>(&word), false});
  sc_core::sc_time delay(7.0, sc_core::SC_NS);
  dut.socket->b_transport(payload, delay);
  EXPECT_EQ(delay, sc_core::sc_time(27.0, sc_core::SC_NS));
  EXPECT_EQ(word, HM_ID_VALUE);
}

INSTANTIATE_TEST_SUITE_P(Bits, BusWidth, testing::Values(32, 64, 128));

} // namespace
} // namespace hopmesh::tests
