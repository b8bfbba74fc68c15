// A hundred thousand payloads made at random, most of them wrong in some way, some in the middle of runs,
// against a shadow of the array: each is answered for a reason that holds, and only good ones do anything.
#include "tests/systemc/payload.h"
#include "tests/systemc/register_table.h"

#include <gtest/gtest.h>

#include <map>

namespace hopmesh::tests {
namespace {

using Response = tlm::tlm_response_status;

class Abuser {
 public:
  explicit Abuser(std::uint64_t seed)
      : dice_(seed), topology_(ring_topology(4)), array_(small_array(32 << seed % 3)),
        dut_("dut", array_, topology_), windows_(window_rows(topology_, array_)) {
    for (const RegisterRow& row : register_rows()) registers_[row.offset] = row;
    while (windows_.back().words == 0) windows_.pop_back();
    Dut::elaborate();
    see_everything();
  }

  void attempt() {
    Attempt a = make();
    const std::vector<unsigned char> before = buffer_;
    tlm::tlm_generic_payload payload;
    fill(payload, a);
    const std::set<Response> reasons = faults(a);
    const Response answer = dut_.send(payload);
    ASSERT_NE(answer, tlm::TLM_INCOMPLETE_RESPONSE);
    ASSERT_FALSE(payload.is_dmi_allowed());
    if (!reasons.empty()) {
      ASSERT_TRUE(reasons.count(answer)) << text(a) << " got " << payload.get_response_string();
      ASSERT_EQ(buffer_, before) << text(a);
      ASSERT_EQ(dut_.last_delay, dut_.device.cells.period() * 2);
      held_ += 2;
      ++refused;
      return;
    }
    ASSERT_EQ(answer, tlm::TLM_OK_RESPONSE) << text(a);
    ++accepted;
    held_ += 1 + (a.length * 8 + array_.bus_bits - 1) / array_.bus_bits;
    if (a.command == tlm::TLM_WRITE_COMMAND) return wrote(a, before);
    for (std::uint64_t k = 0; k < a.length / 4; ++k)
      ASSERT_EQ(word(k), shadow(static_cast<std::uint32_t>(a.address + 4 * k))) << text(a) << " word " << k;
  }

  /// Ends a run that may be on, and takes over what it left; weights and biases must be what they were.
  void settle() {
    if (!busy_) return;
    sc_core::sc_start(dut_.device.cells.period() * 1000000);
    const auto old = memory_;
    const std::uint32_t enable = memory_[HM_REG_IRQ_ENABLE],
                        status = memory_[HM_REG_IRQ_STATUS] | (resetting_ ? 0 : HM_IRQ_DONE);
    see_everything();
    ASSERT_EQ(memory_[HM_REG_STATUS], resetting_ ? 0u : memory_[HM_REG_STATUS] | HM_STATUS_DONE);
    ASSERT_EQ(memory_[HM_REG_STATUS] & HM_STATUS_BUSY, 0u);
    ASSERT_EQ((memory_[HM_REG_STATUS] & HM_STATUS_ABORTED) != 0, aborted_);
    ASSERT_EQ(memory_[HM_REG_IRQ_STATUS], status);
    ASSERT_EQ(dut_.irq.read(), (status & enable) != 0);
    for (const auto& [address, value] : memory_) {
      const bool stays = address >= 0x1000 && !in("OUTPUT", address);
      ASSERT_TRUE(!stays || value == old.at(address)) << std::hex << address;
    }
    busy_ = resetting_ = aborted_ = false;
    ++runs;
  }

  std::uint64_t refused = 0, accepted = 0, runs = 0;

 private:
  Attempt make() {
    Attempt a;
    a.command = dice_.one_in(20)  ? tlm::TLM_IGNORE_COMMAND
                : dice_.one_in(2) ? tlm::TLM_READ_COMMAND
                                  : tlm::TLM_WRITE_COMMAND;
    a.address = address();
    a.length = dice_.one_in(8) ? static_cast<unsigned>(dice_.below(40)) : 4;
    if (a.address >= 0x1000 && dice_.one_in(3)) a.length = 4 * static_cast<unsigned>(dice_.below(200));
    a.streaming_width = dice_.one_in(30) ? static_cast<unsigned>(dice_.below(a.length + 1)) : a.length;
    a.byte_enables = dice_.one_in(40);
    buffer_.resize(1024);
    for (auto& byte : buffer_) byte = static_cast<unsigned char>(dice_.bits());
    if (a.address == HM_REG_MAX_SWEEPS) std::memset(&buffer_[1], 0, 3);
    a.data = dice_.one_in(40) ? nullptr : buffer_.data();
    return a;
  }

  std::uint64_t address() {
    const WindowRow& w = windows_[dice_.below(windows_.size())];
    if (dice_.one_in(40)) return HM_REG_CONTROL;
    switch (dice_.below(8)) {
    case 0:
      return dice_.bits();
    case 1:
      return dice_.below(0x120);
    case 2:
    case 3:
      return std::next(registers_.begin(), static_cast<long>(dice_.below(registers_.size())))->first;
    case 4:
      return w.base + 4 * w.words - 4 * dice_.below(3); // at and just past the end
    case 5:
      return w.base + (dice_.below(2) << (32 + dice_.below(32)));
    default:
      return w.base + 4 * dice_.below(w.words);
    }
  }

  /// All that is wrong with it, as the answers that would say so.
  std::set<Response> faults(const Attempt& a) const {
    std::set<Response> reasons;
    const bool write = a.command == tlm::TLM_WRITE_COMMAND;
    if (!write && a.command != tlm::TLM_READ_COMMAND) reasons.insert(tlm::TLM_COMMAND_ERROR_RESPONSE);
    if (a.byte_enables) reasons.insert(tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
    if (a.length == 0 || a.length % 4 || a.streaming_width < a.length || !a.data)
      reasons.insert(tlm::TLM_BURST_ERROR_RESPONSE);
    const auto at = registers_.find(static_cast<std::uint32_t>(a.address));
    if (a.address <= UINT32_MAX && at != registers_.end()) {
      if (a.length != 4) reasons.insert(tlm::TLM_BURST_ERROR_RESPONSE);
      if (write && at->second.access == Access::RO) reasons.insert(tlm::TLM_COMMAND_ERROR_RESPONSE);
      return reasons;
    }
    for (const WindowRow& w : windows_) {
      if (a.address < w.base || a.address >= w.base + 4 * w.words) continue;
      if (a.address % 4 || a.address + a.length > w.base + 4 * w.words)
        reasons.insert(tlm::TLM_ADDRESS_ERROR_RESPONSE);
      if (busy_ || (write && !w.writable)) reasons.insert(tlm::TLM_COMMAND_ERROR_RESPONSE);
      return reasons;
    }
    reasons.insert(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    return reasons;
  }

  void wrote(const Attempt& a, const std::vector<unsigned char>& sent) {
    ASSERT_EQ(buffer_, sent);
    const auto address = static_cast<std::uint32_t>(a.address);
    if (address == HM_REG_CONTROL) return commanded(word(0));
    for (std::uint64_t k = 0; k < a.length / 4; ++k) {
      const std::uint32_t at = static_cast<std::uint32_t>(address + 4 * k), value = word(k);
      if (address == HM_REG_IRQ_TEST)
        memory_[HM_REG_IRQ_STATUS] |= value & 3;
      else
        memory_[at] = address == HM_REG_IRQ_STATUS ? memory_[at] & ~value : kept(at, value);
    }
  }

  /// No time passes here, so a RESET that came with a START never ends before settle().
  void commanded(std::uint32_t bits) {
    if ((bits & HM_CONTROL_ABORT) && busy_) {
      aborted_ |= !reset_first_;
      if (reset_first_) memory_[HM_REG_IRQ_STATUS] |= HM_IRQ_REFUSED;
    }
    if ((bits & 3) == 0) return;
    if (busy_) {
      memory_[HM_REG_IRQ_STATUS] |= HM_IRQ_REFUSED;
      return;
    }
    reset_first_ = (bits & HM_CONTROL_RESET) != 0;
    resetting_ = (bits & 3) == HM_CONTROL_RESET;
    if (reset_first_) {
      held_ = 0;
      for (auto& [address, value] : memory_) {
        const auto row = registers_.find(address);
        if (row != registers_.end() && address >= HM_REG_CONTROL) value = row->second.reset;
        if (in("BIAS", address) || in("OUTPUT", address) || in("WEIGHT", address)) value = 0;
      }
    }
    busy_ = true;
    memory_[HM_REG_STATUS] = HM_STATUS_BUSY;
  }

  bool in(const std::string& window, std::uint32_t address) const {
    for (const WindowRow& w : windows_)
      if (w.name == window) return w.words > 0 && address >= w.base && address < w.base + 4 * w.words;
    return false;
  }

  /// What the array keeps of a word.
  std::uint32_t kept(std::uint32_t address, std::uint32_t value) const {
    if (address == HM_REG_IRQ_ENABLE) return value & 3;
    if (address == HM_REG_STOP) return value & 0x3F01;
    if (address < 0x1000) return value;
    const spec::Formats& f = array_.formats;
    const bool output = in("OUTPUT", address);
    const int width = (output ? f.state : in("WEIGHT", address) ? f.weight : f.bias).width;
    std::int64_t code = value % (std::int64_t{1} << width);
    if (code >= std::int64_t{1} << (width - 1)) code -= std::int64_t{1} << width;
    if (output) code = std::clamp(code, -f.state.one_raw(), f.state.one_raw());
    return static_cast<std::uint32_t>(code);
  }

  std::uint32_t shadow(std::uint32_t address) {
    if (address == HM_REG_BUS_CYCLES_LO) return static_cast<std::uint32_t>(held_);
    if (address == HM_REG_BUS_CYCLES_HI) return 0;
    return memory_.at(address);
  }

  std::uint32_t word(std::uint64_t k) const {
    std::uint32_t value = 0;
    std::memcpy(&value, &buffer_[4 * k], 4);
    return value;
  }

  void see_everything() {
    for (const auto& [offset, row] : registers_) memory_[offset] = dut_.read(offset), held_ += bus(1);
    for (const WindowRow& w : windows_) {
      const auto words = dut_.read(w.base, w.words);
      for (std::size_t k = 0; k < words.size(); ++k)
        memory_[static_cast<std::uint32_t>(w.base + 4 * k)] = static_cast<std::uint32_t>(words[k]);
      held_ += bus(w.words);
    }
  }
  std::uint64_t bus(std::uint64_t words) const {
    return 1 + (32 * words + array_.bus_bits - 1) / array_.bus_bits;
  }

  static std::string text(const Attempt& a) {
    std::ostringstream s;
    s << "command " << a.command << std::hex << " address 0x" << a.address << std::dec << " length "
      << a.length << " streaming " << a.streaming_width << (a.byte_enables ? " enables" : "")
      << (a.data ? "" : " no data");
    return s.str();
  }

  Dice dice_;
  const spec::Topology topology_;
  const spec::ArraySpec array_;
  Dut dut_;
  std::vector<WindowRow> windows_; ///< that have words
  std::map<std::uint32_t, RegisterRow> registers_;
  std::map<std::uint32_t, std::uint32_t> memory_;
  std::vector<unsigned char> buffer_;
  std::uint64_t held_ = 0;
  /// resetting_: a RESET alone is at work; reset_first_: what is at work began with one.
  bool busy_ = false, resetting_ = false, reset_first_ = false, aborted_ = false;
};

class Abuse : public testing::TestWithParam<int> {};

TEST_P(Abuse, IsAnsweredAndChangesNothing) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  SCOPED_TRACE("seed " + std::to_string(seed));
  Abuser abuser(seed);
  for (int k = 0; k < 10000; ++k) {
    abuser.attempt();
    if (k % 50 == 49) abuser.settle();
    if (HasFatalFailure()) FAIL() << "attempt " << k;
  }
  EXPECT_GT(abuser.refused, 3000u);
  EXPECT_GT(abuser.accepted, 2000u);
  EXPECT_GT(abuser.runs, 20u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Abuse, testing::Range(1, 11));

} // namespace
} // namespace hopmesh::tests
