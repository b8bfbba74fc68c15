#include "sim/engine/device.h"

#include "rtl_model/spec/capabilities.h"

namespace hopmesh::engine {

namespace {

enum class Access { none, RO, RW, WO, W1C };

struct Rule {
  Access access = Access::none;
  std::uint32_t reset = 0;
};

// The one register table, by offset / 4.
const std::array<Rule, 64>& rules() {
  static const std::array<Rule, 64> all = [] {
    std::array<Rule, 64> rule{};
#define HM_X(name, offset, access, reset, meaning) rule[(offset) / 4] = Rule{Access::access, reset};
    HM_REGISTERS(HM_X)
#undef HM_X
    return rule;
  }();
  return all;
}

constexpr std::uint32_t first_volatile = HM_REG_CONTROL; ///< capabilities lie below, and stay

} // namespace

Device::Device(const spec::ArraySpec& array, const spec::Topology& topology, const Options& options,
               const std::atomic<bool>& stop)
    : engine_(array, topology, options), stop_(stop) {
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
bool Device::find(std::uint32_t address, std::uint32_t count, Place& place) const {
  const spec::Topology& t = engine_.topology();
  std::uint32_t base = HM_WINDOW_FIRST_LINK;
  place = {Memory::first_link, 0, t.first_link.size()};
  if (address >= HM_WINDOW_WEIGHT)
    base = HM_WINDOW_WEIGHT, place = {Memory::weight, 0, t.weight_words()};
  else if (address >= HM_WINDOW_OUTPUT)
    base = HM_WINDOW_OUTPUT, place = {Memory::output, 0, t.neurons()};
  else if (address >= HM_WINDOW_BIAS)
    base = HM_WINDOW_BIAS, place = {Memory::bias, 0, t.neurons()};
  else if (address >= HM_WINDOW_LINK)
    base = HM_WINDOW_LINK, place = {Memory::link, 0, t.link_to.size()};
  place.index = (address - base) / 4;
  return place.index < place.words && count <= place.words - place.index;
}

void Device::hold_bus(std::uint32_t words) {
  bus_cycles_ += spec::bus_cycles(engine_.array(), words);
  reg(HM_REG_BUS_CYCLES_LO) = static_cast<std::uint32_t>(bus_cycles_);
  reg(HM_REG_BUS_CYCLES_HI) = static_cast<std::uint32_t>(bus_cycles_ >> 32);
}

int Device::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  if (count == 0 || address % 4 != 0) return HM_ERROR_BUS;
  if (address < HM_WINDOW_FIRST_LINK) {
    const bool there = address / 4 < registers_.size() && rules()[address / 4].access != Access::none;
    if (!there || count != 1) return HM_ERROR_BUS;
    hold_bus(1);
    *words = rules()[address / 4].access == Access::WO ? 0 : reg(address);
    return HM_OK;
  }
  Place place;
  if (!find(address, count, place)) return HM_ERROR_BUS;
  hold_bus(count);
  const spec::Topology& t = engine_.topology();
  switch (place.memory) {
  case Memory::first_link:
    std::copy_n(t.first_link.begin() + static_cast<std::ptrdiff_t>(place.index), count, words);
    break;
  case Memory::link:
    std::copy_n(t.link_to.begin() + static_cast<std::ptrdiff_t>(place.index), count, words);
    break;
  case Memory::bias:
    engine_.read_biases(place.index, words, count);
    break;
  case Memory::output:
    engine_.read_outputs(place.index, words, count);
    break;
  case Memory::weight:
    engine_.read_weights(place.index, words, count);
    break;
  }
  return HM_OK;
}

int Device::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  if (count == 0 || address % 4 != 0) return HM_ERROR_BUS;
  if (address < HM_WINDOW_FIRST_LINK) return count == 1 ? write_register(address, *words) : HM_ERROR_BUS;
  Place place;
  if (!find(address, count, place) || address < HM_WINDOW_BIAS || busy()) return HM_ERROR_BUS;
  hold_bus(count);
  if (place.memory == Memory::bias)
    engine_.write_biases(place.index, words, count);
  else if (place.memory == Memory::output)
    engine_.write_outputs(place.index, words, count);
  else
    engine_.write_weights(place.index, words, count);
  return HM_OK;
}

// ---- registers ----

int Device::write_register(std::uint32_t offset, std::uint32_t word) {
  const Access access = offset / 4 < registers_.size() ? rules()[offset / 4].access : Access::none;
  if (access == Access::none || access == Access::RO) return HM_ERROR_BUS;
  hold_bus(1);
  if (access == Access::RW) reg(offset) = word;
  if (access == Access::W1C) reg(offset) &= ~word;
  if (offset == HM_REG_CONTROL) control(word);
  return HM_OK;
}

void Device::control(std::uint32_t word) {
  if ((word & (HM_CONTROL_START | HM_CONTROL_RESET)) == 0) return;
  if (busy()) {
    reg(HM_REG_IRQ_STATUS) |= HM_IRQ_REFUSED;
    return;
  }
  if (word & HM_CONTROL_RESET) reset();
  if (!(word & HM_CONTROL_START)) return;
  reg(HM_REG_STATUS) = HM_STATUS_BUSY;
  begun_ = false;
  threshold_ = reg(HM_REG_THRESHOLD); // what is written there from now on is for the next run
  max_sweeps_ = reg(HM_REG_MAX_SWEEPS);
}

void Device::reset() {
  for (std::size_t k = first_volatile / 4; k < registers_.size(); ++k) registers_[k] = rules()[k].reset;
  bus_cycles_ = 0;
  const spec::Topology& t = engine_.topology();
  const std::vector<std::uint32_t> zeros(std::max(t.weight_words(), t.neurons()), 0);
  engine_.write_weights(0, zeros.data(), t.weight_words());
  engine_.write_biases(0, zeros.data(), t.neurons());
  engine_.write_outputs(0, zeros.data(), t.neurons());
}

int Device::wait_for_irq() {
  if (irq()) return HM_OK;
  if (stop_) return HM_ERROR_STOPPED;
  if (busy() && !begun_) {
    engine_.begin_run(threshold_, max_sweeps_);
    begun_ = true;
  }
  if (busy() && engine_.advance(stop_)) finish();
  return irq() ? HM_OK : HM_ERROR_STOPPED; // a line that nothing will raise is waited for in vain
}

void Device::finish() {
  const spec::Relaxation& r = engine_.result();
  reg(HM_REG_STATUS) = HM_STATUS_DONE | (r.converged ? HM_STATUS_CONVERGED : 0);
  reg(HM_REG_SWEEPS) = r.sweeps;
  reg(HM_REG_LARGEST_CHANGE) = r.largest_change;
  reg(HM_REG_CYCLES_LO) = static_cast<std::uint32_t>(r.cycles);
  reg(HM_REG_CYCLES_HI) = static_cast<std::uint32_t>(r.cycles >> 32);
  reg(HM_REG_IRQ_STATUS) |= HM_IRQ_DONE;
}

} // namespace hopmesh::engine
