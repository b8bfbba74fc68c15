#include "sim/levels/bus_array.h"

#include "firmware/registers.h"
#include "sim/levels/bus_error.h"

#include <algorithm>

namespace hopmesh::levels {

namespace {

constexpr std::size_t burst_words = 4096;

} // namespace

std::uint32_t BusArray::read(std::uint32_t address) const {
  std::uint32_t word = 0;
  check(bus_.read(bus_.context, address, &word));
  return word;
}

std::uint64_t BusArray::read_wide(std::uint32_t low) const {
  const std::uint64_t high = read(low + 4);
  return high << 32 | read(low);
}

void BusArray::write(std::uint32_t address, std::uint32_t word) const {
  check(bus_.write(bus_.context, address, word));
}

Codes BusArray::read_window(std::uint32_t base, std::size_t count) const {
  Codes codes(count);
  for (std::size_t done = 0; done < count; done += burst_words)
    check(bus_.read_burst(bus_.context, base + static_cast<std::uint32_t>(4 * done),
                          reinterpret_cast<std::uint32_t*>(codes.data() + done),
                          static_cast<std::uint32_t>(std::min(burst_words, count - done))));
  return codes;
}

void BusArray::write_window(std::uint32_t base, const Codes& codes) const {
  for (std::size_t done = 0; done < codes.size(); done += burst_words)
    check(bus_.write_burst(bus_.context, base + static_cast<std::uint32_t>(4 * done),
                           reinterpret_cast<const std::uint32_t*>(codes.data() + done),
                           static_cast<std::uint32_t>(std::min(burst_words, codes.size() - done))));
}

void BusArray::load(const Codes& weights, const Codes& biases, const Codes& outputs) const {
  write_window(HM_WINDOW_WEIGHT, weights);
  write_window(HM_WINDOW_BIAS, biases);
  put_outputs(outputs);
}

void BusArray::put_outputs(const Codes& codes) const {
  write_window(HM_WINDOW_OUTPUT, codes);
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

spec::Relaxation BusArray::last_run() const {
  return {read(HM_REG_SWEEPS), (read(HM_REG_STATUS) & HM_STATUS_CONVERGED) != 0, read(HM_REG_LARGEST_CHANGE),
          read_wide(HM_REG_CYCLES_LO)};
}

std::uint32_t BusArray::threshold() const {
  return read(HM_REG_THRESHOLD);
}

std::uint32_t BusArray::max_sweeps() const {
  return read(HM_REG_MAX_SWEEPS);
}

std::vector<std::uint32_t> BusArray::capabilities() const {
  std::vector<std::uint32_t> words;
  for (std::uint32_t at = HM_REG_CAP_CELLS; at <= HM_REG_CAP_OUTPUT; at += 4) words.push_back(read(at));
  return words;
}

std::uint64_t BusArray::bus_cycles() const {
  return read_wide(HM_REG_BUS_CYCLES_LO);
}

Codes BusArray::weights() const {
  return read_window(HM_WINDOW_WEIGHT, topology_.weight_words());
}

Codes BusArray::biases() const {
  return read_window(HM_WINDOW_BIAS, topology_.neurons());
}

Codes BusArray::outputs() const {
  return read_window(HM_WINDOW_OUTPUT, topology_.neurons());
}

} // namespace hopmesh::levels
