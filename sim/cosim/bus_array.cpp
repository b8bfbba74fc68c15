#include "sim/cosim/bus_array.h"

#include "firmware/registers.h"

#include <algorithm>
#include <string>

namespace hopmesh::cosim {

namespace {

constexpr std::size_t burst_words = 4096;

void must(int error) {
  if (error != HM_OK) throw BusFault(error);
}

} // namespace

BusFault::BusFault(int code)
    : std::runtime_error("the array's bus answered with error " + std::to_string(code)), error(code) {}

std::uint32_t BusArray::read(std::uint32_t address) const {
  std::uint32_t word = 0;
  must(bus_.read(bus_.context, address, &word));
  return word;
}

void BusArray::write(std::uint32_t address, std::uint32_t word) const {
  must(bus_.write(bus_.context, address, word));
}

Codes BusArray::read_window(std::uint32_t base, std::size_t count) const {
  Codes codes(count);
  for (std::size_t done = 0; done < count; done += burst_words)
    must(bus_.read_burst(bus_.context, base + static_cast<std::uint32_t>(4 * done),
                         reinterpret_cast<std::uint32_t*>(codes.data() + done),
                         static_cast<std::uint32_t>(std::min(burst_words, count - done))));
  return codes;
}

void BusArray::write_window(std::uint32_t base, const Codes& codes) const {
  for (std::size_t done = 0; done < codes.size(); done += burst_words)
    must(bus_.write_burst(bus_.context, base + static_cast<std::uint32_t>(4 * done),
                          reinterpret_cast<const std::uint32_t*>(codes.data() + done),
                          static_cast<std::uint32_t>(std::min(burst_words, codes.size() - done))));
}

void BusArray::load(const ArrayJob& job) const {
  write_window(HM_WINDOW_WEIGHT, job.weight);
  write_window(HM_WINDOW_BIAS, job.bias);
  put_outputs(job.start);
}

void BusArray::put_outputs(const Codes& codes) const {
  write_window(HM_WINDOW_OUTPUT, codes);
}

spec::Relaxation BusArray::run(std::uint32_t threshold, std::uint32_t max_sweeps) const {
  write(HM_REG_THRESHOLD, threshold);
  write(HM_REG_MAX_SWEEPS, max_sweeps);
  write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
  write(HM_REG_CONTROL, HM_CONTROL_START);
  must(bus_.wait(bus_.context));
  write(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
  const std::uint64_t high = read(HM_REG_CYCLES_HI);
  return {read(HM_REG_SWEEPS), (read(HM_REG_STATUS) & HM_STATUS_CONVERGED) != 0, read(HM_REG_LARGEST_CHANGE),
          high << 32 | read(HM_REG_CYCLES_LO)};
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

ArrayJob loaded_job(const hm_bus& bus, const spec::ArraySpec& array, const spec::Topology& topology,
                    Codes start) {
  const BusArray there(bus, topology);
  return {array,
          topology,
          there.weights(),
          there.biases(),
          std::move(start),
          there.read(HM_REG_THRESHOLD),
          there.read(HM_REG_MAX_SWEEPS)};
}

} // namespace hopmesh::cosim
