#include "sim/levels/engine_port.h"

#include "firmware/registers.h"

namespace hopmesh::levels {

EnginePort::EnginePort(const spec::ArraySpec& array, const spec::Topology& topology,
                       const engine::Options& options, const WaveRequest& wave, const std::atomic<bool>& stop)
    : device_(array, topology, options, stop), stop_(stop) {
  if (!wave.file.empty()) wave_.emplace(wave, array, topology);
}

int EnginePort::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  const bool was_running = device_.running();
  const int error = device_.read(address, words, count);
  if (wave_) show(was_running);
  return error;
}

int EnginePort::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  const bool was_running = device_.running();
  const int error = device_.write(address, words, count);
  if (wave_) show(was_running);
  return error;
}

int EnginePort::wait_for_irq() {
  const bool was_running = device_.running();
  const int error = device_.wait_for_irq();
  if (wave_) show(was_running);
  return error;
}

// A run is shown as soon as it was started, before the engine has computed any of it.
void EnginePort::show(bool was_running) {
  const bool is_running = device_.running();
  if (was_running && !is_running)
    wave_->ran(device_.engine(), (device_.peek(HM_REG_STATUS) & HM_STATUS_ABORTED) != 0);
  wave_->irq(device_.irq(), device_.held());
  if (!was_running && is_running)
    wave_->run(device_.engine(), {device_.threshold(), device_.max_sweeps(), device_.stop_rule()},
               device_.held(), stop_);
}

void EnginePort::begin_step(std::uint64_t step) {
  if (wave_) wave_->begin_step(step);
}

void EnginePort::end_step(std::uint64_t step) {
  if (wave_) wave_->end_step(step, device_.held());
}

void EnginePort::finish() {
  if (wave_) wave_->finish();
}

std::vector<SignalRange> EnginePort::inner_ranges() const {
  const engine::Engine& e = device_.engine();
  return levels::inner_ranges(e.array(), e.topology(), e.extremes());
}

} // namespace hopmesh::levels
