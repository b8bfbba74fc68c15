#include "sim/engine/device.h"

#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/cycles.h"
#include "sim/engine/packed_words.h"

namespace hopmesh::engine {

namespace {

enum class Access { none, RO, RW, WO, W1C };

struct Rule {
  Access access = Access::none;
  std::uint32_t reset = 0, fields = 0;
};

// The one register table, by offset / 4.
const std::array<Rule, 64>& rules() {
  static const std::array<Rule, 64> all = [] {
    std::array<Rule, 64> rule{};
#define HM_X(name, offset, access, reset, meaning) rule[(offset) / 4] = Rule{Access::access, reset, 0};
    HM_REGISTERS(HM_X)
#undef HM_X
#define HM_X(reg, field, lowest, width, access, meaning)                                                     \
  rule[HM_REG_##reg / 4].fields |= HM_MASK_##reg##_##field;
    HM_FIELDS(HM_X)
#undef HM_X
    return rule;
  }();
  return all;
}

Rule rule_of(std::uint32_t offset) {
  return offset / 4 < rules().size() ? rules()[offset / 4] : Rule();
}

constexpr std::uint32_t first_volatile = HM_REG_CONTROL; ///< capabilities lie below, and stay

} // namespace

Device::Device(const spec::ArraySpec& array, const spec::Topology& topology, const Options& options,
               const std::atomic<bool>& stop)
    : engine_(array, topology, options), map_(spec::memory_map(array, topology)), stop_(stop) {
  for (std::size_t k = 0; k < registers_.size(); ++k) registers_[k] = rules()[k].reset;
  for (const auto& [offset, word] : spec::capability_words(array, topology, engine_.phases()))
    reg(offset) = word;
}

bool Device::busy() const {
  return (reg(HM_REG_STATUS) & HM_STATUS_BUSY) != 0;
}

bool Device::irq() const {
  return (reg(HM_REG_IRQ_STATUS) & reg(HM_REG_IRQ_ENABLE)) != 0;
}

// ---- the bus ----

// A register, or a burst that stays inside its window.
Device::Place Device::find(std::uint32_t address, std::uint32_t count) const {
  Place place;
  if (count == 0 || address % 4 != 0) return place;
  if (address < HM_REGISTER_BYTES) {
    place.there = count == 1 && rule_of(address).access != Access::none;
    return place;
  }
  for (std::size_t k = 0; k < spec::window_count; ++k) {
    const spec::MemoryWindow& window = map_.window[k];
    if (!window.holds(address)) continue;
    const std::uint64_t index = (address - window.offset) / 4;
    return {count <= window.words() - index, &window, static_cast<spec::Window>(k), index};
  }
  return place;
}

void Device::hold_bus(std::uint64_t cycles) {
  held_ += cycles;
  now_ += cycles;
}

int Device::refuse() {
  hold_bus(spec::error_cycles);
  return HM_ERROR_BUS;
}

int Device::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  catch_up();
  const Place place = find(address, count);
  if (!place.there || (place.window && busy())) return refuse();
  hold_bus(spec::bus_cycles(engine_.array(), count));
  if (place.window)
    read_window(place, words, count);
  else
    *words = read_register(address);
  return HM_OK;
}

int Device::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  catch_up();
  const Place place = find(address, count);
  const bool writable =
      place.window ? spec::is_writable(place.which) && !busy() : rule_of(address).access != Access::RO;
  if (!place.there || !writable) return refuse();
  if (place.window) {
    hold_bus(spec::bus_cycles(engine_.array(), count));
    write_window(place, words, count);
  } else {
    write_register(address, *words);
  }
  return HM_OK;
}

// ---- windows ----

void Device::read_window(const Place& place, std::uint32_t* words, std::uint32_t count) {
  const auto n = static_cast<std::uint64_t>(place.window->codes_a_word);
  const std::uint64_t first = n * place.index, codes = std::min(n * count, place.window->codes - first);
  if (n == 1) return read_codes(place.which, first, words, codes);
  codes_.resize(codes);
  read_codes(place.which, first, codes_.data(), codes);
  put_together(codes_.data(), codes, place.window->codes_a_word, words);
}

void Device::write_window(const Place& place, const std::uint32_t* words, std::uint32_t count) {
  const auto n = static_cast<std::uint64_t>(place.window->codes_a_word);
  const std::uint64_t first = n * place.index, codes = std::min(n * count, place.window->codes - first);
  if (n == 1) return write_codes(place.which, first, words, codes);
  codes_.resize(n * count);
  take_apart(words, count, place.window->codes_a_word, codes_.data());
  write_codes(place.which, first, codes_.data(), codes);
}

void Device::read_codes(spec::Window window, std::uint64_t first, std::uint32_t* words,
                        std::uint64_t count) const {
  const spec::Topology& t = engine_.topology();
  switch (window) {
  case spec::Window::FIRST_LINK:
    std::copy_n(t.first_link.begin() + static_cast<std::ptrdiff_t>(first), count, words);
    break;
  case spec::Window::LINK:
    std::copy_n(t.link_to.begin() + static_cast<std::ptrdiff_t>(first), count, words);
    break;
  case spec::Window::BIAS:
    engine_.read_biases(first, words, count);
    break;
  case spec::Window::OUTPUT:
    engine_.read_outputs(first, words, count);
    break;
  case spec::Window::WEIGHT:
    engine_.read_weights(first, words, count);
    break;
  case spec::Window::MOMENTUM:
    engine_.read_momentum(first, words, count);
    break;
  }
}

void Device::write_codes(spec::Window window, std::uint64_t first, const std::uint32_t* words,
                         std::uint64_t count) {
  if (window == spec::Window::BIAS)
    engine_.write_biases(first, words, count);
  else if (window == spec::Window::OUTPUT)
    engine_.write_outputs(first, words, count);
  else if (window == spec::Window::MOMENTUM)
    engine_.write_momentum(first, words, count);
  else
    engine_.write_weights(first, words, count);
}

// ---- registers ----

// A low word takes its high one along.
std::uint32_t Device::read_register(std::uint32_t offset) {
  if (offset == HM_REG_CYCLES_LO) reg(HM_REG_CYCLES_HI) = static_cast<std::uint32_t>(run_cycles_ >> 32);
  if (offset == HM_REG_LARGEST_SUM_LO)
    reg(HM_REG_LARGEST_SUM_HI) = static_cast<std::uint32_t>(largest_sum_ >> 32);
  if (offset == HM_REG_BUS_CYCLES_LO) {
    reg(HM_REG_BUS_CYCLES_LO) = static_cast<std::uint32_t>(held_ - held_at_reset_);
    reg(HM_REG_BUS_CYCLES_HI) = static_cast<std::uint32_t>((held_ - held_at_reset_) >> 32);
  }
  return rule_of(offset).access == Access::WO ? 0 : reg(offset);
}

void Device::write_register(std::uint32_t offset, std::uint32_t word) {
  const Rule rule = rule_of(offset);
  const std::uint64_t asked_at = now_;
  hold_bus(spec::bus_cycles(engine_.array(), 1));
  if (rule.access == Access::RW) reg(offset) = word & rule.fields;
  if (rule.access == Access::W1C) reg(offset) &= ~word;
  if (offset == HM_REG_IRQ_TEST) reg(HM_REG_IRQ_STATUS) |= word & rule.fields;
  if (offset == HM_REG_CONTROL) control(word, asked_at);
}

void Device::reset_registers() {
  for (std::size_t k = first_volatile / 4; k < registers_.size(); ++k) registers_[k] = rules()[k].reset;
}

} // namespace hopmesh::engine
