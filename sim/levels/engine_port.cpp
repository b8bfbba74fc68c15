#include "sim/levels/engine_port.h"

#include "firmware/registers.h"

namespace hopmesh::levels {

EnginePort::EnginePort(const spec::ArraySpec& array, const spec::Topology& topology,
                       const engine::Options& options, const WaveRequest& wave, const std::atomic<bool>& stop)
    : device_(array, topology, options, stop), stop_(stop) {
  if (wave.file.empty()) return;
  wave_.emplace(wave, array, topology);
  bus_.context = this;
  bus_.read = [](void* c, std::uint32_t address, std::uint32_t* word) {
    const hm_bus& bus = static_cast<EnginePort*>(c)->device_.bus();
    return bus.read(bus.context, address, word);
  };
  bus_.write = [](void* c, std::uint32_t address, std::uint32_t word) {
    return static_cast<EnginePort*>(c)->write(address, word);
  };
  bus_.read_burst = [](void* c, std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
    const hm_bus& bus = static_cast<EnginePort*>(c)->device_.bus();
    return bus.read_burst(bus.context, address, words, count);
  };
  bus_.write_burst = [](void* c, std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
    const hm_bus& bus = static_cast<EnginePort*>(c)->device_.bus();
    return bus.write_burst(bus.context, address, words, count);
  };
  bus_.wait = [](void* c) { return static_cast<EnginePort*>(c)->wait(); };
}

std::uint64_t EnginePort::bus_cycles() const {
  return std::uint64_t{device_.peek(HM_REG_BUS_CYCLES_HI)} << 32 | device_.peek(HM_REG_BUS_CYCLES_LO);
}

int EnginePort::write(std::uint32_t address, std::uint32_t word) {
  const int error = device_.bus().write(device_.bus().context, address, word);
  wave_->irq(device_.irq(), bus_cycles());
  return error;
}

int EnginePort::wait() {
  const bool runs = (device_.peek(HM_REG_STATUS) & HM_STATUS_BUSY) != 0;
  if (runs)
    wave_->run(device_.engine(), device_.peek(HM_REG_THRESHOLD), device_.peek(HM_REG_MAX_SWEEPS),
               bus_cycles(), stop_);
  const int error = device_.bus().wait(device_.bus().context);
  if (runs && (device_.peek(HM_REG_STATUS) & HM_STATUS_BUSY) == 0) wave_->ran(device_.engine());
  wave_->irq(device_.irq(), bus_cycles());
  return error;
}

void EnginePort::begin_step(std::uint64_t step) {
  if (wave_) wave_->begin_step(step);
}

void EnginePort::end_step(std::uint64_t step) {
  if (wave_) wave_->end_step(step, bus_cycles());
}

void EnginePort::finish() {
  if (wave_) wave_->finish();
}

std::vector<SignalRange> EnginePort::inner_ranges() const {
  const engine::Engine& e = device_.engine();
  return levels::inner_ranges(e.array(), e.topology(), e.extremes());
}

} // namespace hopmesh::levels
