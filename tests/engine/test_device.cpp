// The engine's device and the SystemC device behind the same five calls, transfer by transfer: random bus
// traffic, good and bad, before, during and after runs and resets, polls and aborts in the middle of them:
// every answer, every word, every register equal, to the cycle, bus cycles included. SystemC's host waits
// every transfer out, so that both see time pass alike.
#include "sim/engine/device.h"
#include "tests/engine/engine_bench.h"
#include "tests/systemc/register_table.h"

namespace hopmesh::tests {
namespace {

using Words = std::vector<std::uint32_t>;

/// What both devices are asked to do, and how it went.
struct Tally {
  std::uint64_t accepted = 0, refused = 0, waits = 0, resets = 0, refused_starts = 0, aborts = 0,
                polled_ends = 0;

  void add(const Tally& t) {
    accepted += t.accepted, refused += t.refused, waits += t.waits, resets += t.resets;
    refused_starts += t.refused_starts, aborts += t.aborts, polled_ends += t.polled_ends;
  }
};

class Lockstep {
 public:
  explicit Lockstep(std::uint64_t seed)
      : dice_(seed), topology_(random_topology(dice_, 8)), array_(random_array(dice_, topology_.most_taps())),
        windows_(window_rows(topology_, array_)),
        dut_(("dut" + std::to_string(seed)).c_str(), array_, topology_),
        device_(array_, topology_, {1, dice_.one_in(2) ? "auto" : "generic", 1}, stop_) {
    for (const RegisterRow& row : register_rows()) offsets_.push_back(row.offset);
    if (dice_.one_in(4)) dut_.device.wake(systemc::Waking::by_clock);
  }

  /// A few transfers, mostly about one run.
  void sequence() {
    if (dice_.one_in(2)) limits();
    if (dice_.one_in(3)) interrupts();
    if (dice_.one_in(3)) burst();
    control(dice_.one_in(8) ? HM_CONTROL_RESET | HM_CONTROL_START : HM_CONTROL_START);
    for (std::uint64_t k = dice_.below(12); k > 0; --k) act();
    if (dice_.one_in(2)) poll();
    if (dice_.one_in(2)) wait();
  }

  /// Everything that a host can see.
  void compare_all() {
    for (std::uint32_t offset = 0; offset < 0x120; offset += 4) read(offset, 1);
    for (const WindowRow& w : windows_)
      if (w.words > 0) read(w.base, static_cast<std::uint32_t>(w.words));
  }

  /// Ends a run that may be on; the line shows what the registers say.
  void settle() {
    stop_ = false;
    write(HM_REG_IRQ_STATUS, {~0u});
    wait();
    compare_all();
    dut_.pass_delay();
    sc_core::sc_start(dut_.device.cells.period() * 1000);
    ASSERT_EQ(dut_.irq.read(), device_.irq());
  }

  const Tally& tally() const { return tally_; }
  std::string text() const { return describe(ArrayJob{array_, topology_, {}, {}, {}, 0, 0}); }

 private:
  const hm_bus& engine() { return device_.bus(); }

  void act() {
    switch (dice_.below(16)) {
    case 0:
      return wait();
    case 1:
    case 2:
      return control(static_cast<std::uint32_t>(dice_.one_in(3) ? dice_.bits() : dice_.below(8)));
    case 3:
      return interrupts();
    case 4:
      return limits();
    case 5:
      return one_word(any_address());
    case 6:
      return burst();
    default:
      return read(offsets_[dice_.below(offsets_.size())], 1);
    }
  }

  /// Asks until the array is at rest, or patience ends.
  void poll() {
    const bool was_busy = busy();
    for (std::uint64_t patience = dice_.below(400); patience > 0 && busy(); --patience)
      read(HM_REG_STATUS, 1);
    tally_.polled_ends += was_busy && !busy();
  }

  int ask_systemc(tlm::tlm_command command, std::uint32_t address, const std::uint32_t* words,
                  std::size_t count) {
    dut_.pass_delay();
    const auto answer =
        dut_.transfer(command, address, const_cast<std::uint32_t*>(words), static_cast<unsigned>(4 * count));
    return answer == tlm::TLM_OK_RESPONSE ? HM_OK : HM_ERROR_BUS;
  }

  void answer(int systemc, int engine, const char* what, std::uint32_t address, std::size_t count) {
    ASSERT_EQ(engine, systemc) << what << " of " << count << " at 0x" << std::hex << address;
    ASSERT_EQ(device_.irq(), line_up());
    (systemc == HM_OK ? tally_.accepted : tally_.refused) += 1;
  }

  void read(std::uint32_t address, std::uint32_t count) {
    Words a(count + 2, 0xA5A5A5A5u), b = a;
    const bool single = count == 1 && dice_.one_in(2);
    const int x = ask_systemc(tlm::TLM_READ_COMMAND, address, a.data(), count);
    const int y = single ? engine().read(engine().context, address, b.data())
                         : engine().read_burst(engine().context, address, b.data(), count);
    answer(x, y, "read", address, count);
    ASSERT_EQ(b, a) << "at 0x" << std::hex << address;
  }

  void write(std::uint32_t address, const Words& words) {
    const auto count = static_cast<std::uint32_t>(words.size());
    const bool single = count == 1 && dice_.one_in(2);
    const std::uint32_t* data = words.empty() ? offsets_.data() : words.data(); // there, and not looked at
    const int x = ask_systemc(tlm::TLM_WRITE_COMMAND, address, data, count);
    const int y = single ? engine().write(engine().context, address, *data)
                         : engine().write_burst(engine().context, address, data, count);
    answer(x, y, "write", address, count);
  }

  std::uint32_t peek(std::uint32_t offset) {
    std::uint32_t word = 0;
    tlm::tlm_generic_payload payload;
    payload.set_command(tlm::TLM_READ_COMMAND);
    payload.set_address(offset);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
    payload.set_data_length(4);
    dut_.socket->transport_dbg(payload);
    return word;
  }
  bool busy() { return (peek(HM_REG_STATUS) & HM_STATUS_BUSY) != 0; }
  bool line_up() { return (peek(HM_REG_IRQ_STATUS) & peek(HM_REG_IRQ_ENABLE)) != 0; }

  /// As the engine promises it: a line that is up ends it at once, a stop too, and else what is at work is
  /// seen through.
  int wait_for_systemc() {
    dut_.pass_delay();
    if (line_up()) return HM_OK;
    if (stop_) return HM_ERROR_STOPPED;
    tally_.waits += busy();
    while (busy()) {
      sc_core::sc_start(sc_core::sc_time_to_pending_activity());
      dut_.pass_delay();
    }
    return line_up() ? HM_OK : HM_ERROR_STOPPED;
  }
  void wait() {
    ASSERT_EQ(engine().wait(engine().context), wait_for_systemc());
    ASSERT_EQ(device_.irq(), line_up());
  }

  void control(std::uint32_t word) {
    dut_.pass_delay();
    tally_.refused_starts += busy() && (word & 3);
    tally_.resets += !busy() && (word & HM_CONTROL_RESET);
    tally_.aborts += busy() && (word & HM_CONTROL_ABORT);
    write(HM_REG_CONTROL, {word});
  }
  void interrupts() {
    constexpr std::uint32_t offsets[] = {HM_REG_IRQ_ENABLE, HM_REG_IRQ_STATUS, HM_REG_IRQ_TEST};
    write(offsets[dice_.below(3)], {static_cast<std::uint32_t>(dice_.bits())});
  }
  void limits() {
    if (dice_.one_in(8)) stop_ = !stop_;
    const bool sweeps = dice_.one_in(2);
    write(sweeps ? HM_REG_MAX_SWEEPS : HM_REG_THRESHOLD,
          {static_cast<std::uint32_t>(dice_.below(sweeps            ? 9
                                                  : dice_.one_in(2) ? 3
                                                                    : 3000))});
  }

  std::uint32_t any_address() {
    const WindowRow& w = windows_[dice_.below(windows_.size())];
    const auto end = static_cast<std::uint32_t>(w.base + 4 * w.words);
    switch (dice_.below(8)) {
    case 0:
      return static_cast<std::uint32_t>(dice_.bits());
    case 1:
      return static_cast<std::uint32_t>(dice_.below(0x120)); // mostly no multiple of four
    case 2:
      return end - 4 + 4 * static_cast<std::uint32_t>(dice_.below(3)); // at and just past the end
    case 3:
      return w.base - 4;
    case 4:
      return w.base + 4 * static_cast<std::uint32_t>(dice_.below(w.words + 1));
    default:
      return offsets_[dice_.below(offsets_.size())];
    }
  }
  void one_word(std::uint32_t address) {
    const bool bounded = address / 4 == HM_REG_MAX_SWEEPS / 4; // or a run would take for ever
    const auto word = static_cast<std::uint32_t>(bounded ? dice_.below(9) : dice_.bits());
    dice_.one_in(2) ? read(address, 1) : write(address, {word});
  }
  /// Most of them inside a window; some of no words, some too long, some at registers.
  void burst() {
    const WindowRow& w = windows_[dice_.below(windows_.size())];
    const std::uint64_t first = dice_.below(w.words + 1), room = w.words - first;
    const auto address = dice_.one_in(8) ? any_address() : static_cast<std::uint32_t>(w.base + 4 * first);
    const bool reckless = dice_.one_in(6) || address == HM_REG_MAX_SWEEPS;
    const auto count =
        static_cast<std::uint32_t>(reckless ? dice_.below(4) * dice_.below(90) : dice_.below(room + 1));
    if (dice_.one_in(2)) return read(address, count);
    Words words(count);
    for (auto& word : words) word = static_cast<std::uint32_t>(dice_.bits() >> dice_.below(33));
    if (address != HM_REG_MAX_SWEEPS || count != 1) write(address, words);
  }

  Dice dice_;
  const spec::Topology topology_;
  const spec::ArraySpec array_;
  const std::vector<WindowRow> windows_;
  Words offsets_;
  Tally tally_;
  std::atomic<bool> stop_{false};
  Dut dut_;
  engine::Device device_;
};

class EngineDevice : public testing::TestWithParam<int> {};

TEST_P(EngineDevice, AnswersAsSystemCDoes) {
  std::vector<std::unique_ptr<Lockstep>> all;
  constexpr std::uint64_t devices = 40, sequences = 2500;
  const std::uint64_t first = 1000000 + devices * static_cast<std::uint64_t>(GetParam());
  for (std::uint64_t seed = first; seed < first + devices; ++seed)
    all.push_back(std::make_unique<Lockstep>(seed));
  Tally sum;
  for (std::uint64_t k = 0; k < devices; ++k) {
    SCOPED_TRACE("seed " + std::to_string(first + k) + ": " + all[k]->text());
    all[k]->compare_all(); // as they leave the factory
    for (std::uint64_t at = 0; at < sequences; ++at) {
      all[k]->sequence();
      if (at % 25 == 24) all[k]->compare_all();
      if (HasFatalFailure()) FAIL() << "sequence " << at;
    }
    all[k]->settle();
    sum.add(all[k]->tally());
  }
  EXPECT_GT(sum.accepted, 20000 * devices);
  EXPECT_GT(sum.refused, 4000 * devices);
  EXPECT_GT(sum.waits, 200 * devices);
  EXPECT_GT(sum.polled_ends, 200 * devices);
  EXPECT_GT(sum.resets, 200 * devices);
  EXPECT_GT(sum.refused_starts, 400 * devices);
  EXPECT_GT(sum.aborts, 400 * devices);
}

INSTANTIATE_TEST_SUITE_P(Batch, EngineDevice, testing::Range(0, 4));

} // namespace
} // namespace hopmesh::tests
