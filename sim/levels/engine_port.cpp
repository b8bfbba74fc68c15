#include "sim/levels/engine_port.h"

#include "firmware/registers.h"

namespace hopmesh::levels {

EnginePort::EnginePort(const spec::ArraySpec& array, const spec::Topology& topology,
                       const engine::Options& options, const WaveRequest& wave, const std::atomic<bool>& stop)
    : device_(array, topology, options, stop), stop_(stop) {
  if (!wave.file.empty()) wave_.emplace(wave, array, topology);
}

int EnginePort::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  const int error = device_.write(address, words, count);
  if (wave_) wave_->irq(device_.irq(), device_.bus_cycles());
  return error;
}

int EnginePort::wait_for_irq() {
  if (!wave_) return device_.wait_for_irq();
  const int error = device_.busy() ? waved_run() : device_.wait_for_irq();
  wave_->irq(device_.irq(), device_.bus_cycles());
  return error;
}

int EnginePort::waved_run() {
  wave_->run(device_.engine(), device_.peek(HM_REG_THRESHOLD), device_.peek(HM_REG_MAX_SWEEPS),
             device_.bus_cycles(), stop_);
  const int error = device_.wait_for_irq();
  if (!device_.busy()) wave_->ran(device_.engine());
  return error;
}

void EnginePort::begin_step(std::uint64_t step) {
  if (wave_) wave_->begin_step(step);
}

void EnginePort::end_step(std::uint64_t step) {
  if (wave_) wave_->end_step(step, device_.bus_cycles());
}

void EnginePort::finish() {
  if (wave_) wave_->finish();
}

std::vector<SignalRange> EnginePort::inner_ranges() const {
  const engine::Engine& e = device_.engine();
  return levels::inner_ranges(e.array(), e.topology(), e.extremes());
}

} // namespace hopmesh::levels
