#include "sim/levels/bus_array.h"

#include "firmware/registers.h"
#include "rtl_model/spec/capabilities.h"
#include "sim/levels/array_port.h"
#include "sim/levels/bus_error.h"

#include <algorithm>

namespace hopmesh::levels {

std::uint32_t BusArray::read(std::uint32_t address) const {
  std::uint32_t word = 0;
  check(bus_.read(bus_.context, address, &word));
  return word;
}

// The low word first: reading it keeps the high one that belongs to it.
std::uint64_t BusArray::read_wide(std::uint32_t low) const {
  const std::uint64_t word = read(low);
  return word | static_cast<std::uint64_t>(read(low + 4)) << 32;
}

void BusArray::write(std::uint32_t address, std::uint32_t word) const {
  check(bus_.write(bus_.context, address, word));
}

BusArray::Window BusArray::weight_window() const {
  const std::uint32_t packing = read(HM_REG_CAP_PACKING);
  return {read(HM_REG_CAP_WINDOW_WEIGHT), static_cast<int>(HM_FIELD(packing, CAP_PACKING_WEIGHT))};
}

BusArray::Window BusArray::bias_window() const {
  const std::uint32_t packing = read(HM_REG_CAP_PACKING);
  return {read(HM_REG_CAP_WINDOW_BIAS), static_cast<int>(HM_FIELD(packing, CAP_PACKING_BIAS))};
}

BusArray::Window BusArray::output_window() const {
  const std::uint32_t packing = read(HM_REG_CAP_PACKING);
  return {read(HM_REG_CAP_WINDOW_OUTPUT), static_cast<int>(HM_FIELD(packing, CAP_PACKING_OUTPUT))};
}

BusArray::Window BusArray::momentum_window() const {
  const std::uint32_t packing = read(HM_REG_CAP_PACKING);
  return {read(HM_REG_CAP_WINDOW_MOMENTUM), static_cast<int>(HM_FIELD(packing, CAP_PACKING_MOMENTUM))};
}

Codes BusArray::read_window(const Window& window, std::size_t count) const {
  const auto n = static_cast<std::size_t>(window.codes_a_word);
  std::vector<std::uint32_t> words((count + n - 1) / n);
  for (std::size_t done = 0; done < words.size(); done += longest_burst)
    check(bus_.read_burst(bus_.context, window.base + static_cast<std::uint32_t>(4 * done),
                          words.data() + done,
                          static_cast<std::uint32_t>(std::min(longest_burst, words.size() - done))));
  Codes codes(count);
  for (std::size_t k = 0; k < count; ++k) codes[k] = code_in(words.data(), window.codes_a_word, k);
  return codes;
}

void BusArray::write_window(const Window& window, const Codes& codes) const {
  const std::vector<std::uint32_t> words = packed(codes, window.codes_a_word);
  for (std::size_t done = 0; done < words.size(); done += longest_burst)
    check(bus_.write_burst(bus_.context, window.base + static_cast<std::uint32_t>(4 * done),
                           words.data() + done,
                           static_cast<std::uint32_t>(std::min(longest_burst, words.size() - done))));
}

void BusArray::load(const Codes& weights, const Codes& biases, const Codes& outputs) const {
  write_window(weight_window(), weights);
  write_window(bias_window(), biases);
  put_outputs(outputs);
}

void BusArray::put_outputs(const Codes& codes) const {
  write_window(output_window(), codes);
}

spec::Relaxation BusArray::run(std::uint32_t threshold, std::uint32_t max_sweeps) const {
  write(HM_REG_THRESHOLD, threshold);
  write(HM_REG_MAX_SWEEPS, max_sweeps);
  write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
  write(HM_REG_CONTROL, HM_CONTROL_START);
  check(bus_.wait(bus_.context));
  write(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
  return last_run();
}

spec::Relaxation BusArray::run(std::uint32_t threshold, std::uint32_t max_sweeps,
                               const spec::StopRule& rule) const {
  write(HM_REG_STOP, spec::stop_word(rule));
  write(HM_REG_SUM_THRESHOLD_LO, static_cast<std::uint32_t>(rule.floor));
  write(HM_REG_SUM_THRESHOLD_HI, static_cast<std::uint32_t>(rule.floor >> 32));
  return run(threshold, max_sweeps);
}

spec::Relaxation BusArray::last_run() const {
  return {read(HM_REG_SWEEPS), (read(HM_REG_STATUS) & HM_STATUS_CONVERGED) != 0, read(HM_REG_LARGEST_CHANGE),
          read_wide(HM_REG_CYCLES_LO), read_wide(HM_REG_LARGEST_SUM_LO)};
}

std::uint32_t BusArray::threshold() const {
  return read(HM_REG_THRESHOLD);
}

std::uint32_t BusArray::max_sweeps() const {
  return read(HM_REG_MAX_SWEEPS);
}

spec::StopRule BusArray::stop_rule() const {
  const std::uint32_t stop = read(HM_REG_STOP);
  return {HM_FIELD(stop, STOP_BY_SUM) != 0, static_cast<int>(HM_FIELD(stop, STOP_SHARE)),
          read_wide(HM_REG_SUM_THRESHOLD_LO)};
}

std::vector<std::uint32_t> BusArray::capabilities() const {
  std::vector<std::uint32_t> words;
#define HM_X(name, offset, access, reset, meaning)                                                           \
  if ((offset) >= HM_REG_CAP_CELLS && (offset) < HM_REG_CONTROL) words.push_back(read(offset));
  HM_REGISTERS(HM_X)
#undef HM_X
  return words;
}

std::uint64_t BusArray::bus_cycles() const {
  return read_wide(HM_REG_BUS_CYCLES_LO);
}

Codes BusArray::weights() const {
  return read_window(weight_window(), topology_.weight_words());
}

Codes BusArray::biases() const {
  return read_window(bias_window(), topology_.neurons());
}

Codes BusArray::outputs() const {
  return read_window(output_window(), topology_.neurons());
}

void BusArray::put_momentum(const Codes& codes) const {
  write_window(momentum_window(), codes);
}

Codes BusArray::momentum(std::size_t entries) const {
  return read_window(momentum_window(), entries);
}

} // namespace hopmesh::levels
