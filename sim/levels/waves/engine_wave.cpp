#include "sim/levels/waves/engine_wave.h"

#include <cmath>
#include <stdexcept>

namespace hopmesh::levels {

namespace {

/// Picoseconds, rounded as sc_time rounds them.
std::uint64_t period_of(const spec::ArraySpec& array) {
  return static_cast<std::uint64_t>(std::llround(1.0 / array.clock_mhz * 1e6));
}

} // namespace

EngineWave::EngineWave(WaveRequest request, const spec::ArraySpec& array, const spec::Topology& topology)
    : request_(std::move(request)), period_(period_of(array)),
      stepped_array_(engine::make_clock_stepped(array, topology)), array_(*stepped_array_) {
  check_wave(request_, topology.cells());
}

EngineWave::~EngineWave() {
  finish();
  if (!trouble_.empty() || !began_ || done_) return;
  warn_empty_window(request_);
}

void EngineWave::finish() {
  if (vcd_) close(2 * now_);
}

// A file that cannot be written ends the wave, never the run.
void EngineWave::guarded(const std::function<void()>& write) {
  try {
    write();
  } catch (const files::WriteError& error) {
    vcd_.reset();
    done_ = true;
    trouble_ = error.what();
  }
}

void EngineWave::open() {
  guarded([&] { vcd_.emplace(request_, array_, period_, irq_); });
}

void EngineWave::close(std::uint64_t halves) {
  guarded([&] {
    vcd_->finish(halves);
    vcd_.reset();
  });
  done_ = true;
}

void EngineWave::begin_step(std::uint64_t step) {
  began_ = true;
  step_ = step;
  if (!request_.in_cycles && !vcd_ && !done_ && step >= request_.first && step < request_.last) open();
}

void EngineWave::end_step(std::uint64_t step, std::uint64_t bus) {
  now_ += bus - bus_;
  bus_ = bus;
  if (!vcd_) return;
  guarded([&] { vcd_->pass(2 * now_); });
  if (vcd_ && (request_.in_cycles ? total_ >= request_.last : step + 1 >= request_.last)) close(2 * now_);
}

// The registers as the window finds them are what the run before it left, so that one is stepped as well;
// which run that is, nobody knows before it is over where the window counts cycles.
bool EngineWave::wants(std::uint32_t max_sweeps) const {
  if (vcd_ || done_) return vcd_.has_value();
  if (!request_.in_cycles) return step_ + 1 >= request_.first && step_ < request_.last;
  return total_ + 2 * array_.cycles().run(std::max(max_sweeps, 1u)) > request_.first;
}

void EngineWave::load(const engine::Engine& array) {
  std::vector<std::uint32_t> words(std::max(array.topology().weight_words(), array.topology().neurons()));
  array.read_weights(0, words.data(), array.topology().weight_words());
  array_.write_weights(0, words.data(), array.topology().weight_words());
  array.read_biases(0, words.data(), array.topology().neurons());
  array_.write_biases(0, words.data(), array.topology().neurons());
  array.read_outputs(0, words.data(), array.topology().neurons());
  array_.write_outputs(0, words.data(), array.topology().neurons());
  if (!spec::has_momentum(array.array())) return;
  words.resize(static_cast<std::size_t>(array.array().momentum_entries));
  array.read_momentum(0, words.data(), words.size());
  array_.write_momentum(0, words.data(), words.size());
}

void EngineWave::run(const engine::Engine& array, const RunLimits& limits, std::uint64_t bus,
                     const std::atomic<bool>& stop) {
  run_began_ = now_ + (bus - bus_);
  bus_ = bus;
  stepped_ = wants(limits.max_sweeps);
  if (!stepped_) return;
  load(array);
  array_.start(limits.threshold, limits.max_sweeps, limits.rule);
  if (vcd_) {
    guarded([&] {
      vcd_->show_host(2 * now_);
      vcd_->show_start(2 * run_began_);
    });
  }
  now_ = run_began_;
  while (array_.busy() && !stop) advance();
}

// A clock where it shows; else up to where the window begins, which is the middle of its first cycle: an
// edge belongs to the cycle that it ends.
void EngineWave::advance() {
  constexpr std::uint64_t stride = 1 << 16; // a run of many cycles can be stopped
  const bool counts = request_.in_cycles && !done_;
  if (vcd_ && counts && total_ + cycles() >= request_.last) return close(2 * (run_began_ + cycles()) + 1);
  if (vcd_) return clock();
  const std::uint64_t ahead = counts && request_.first > total_ ? request_.first - total_ : 0;
  if (!counts || cycles() < ahead) return array_.step(counts ? ahead - cycles() : stride);
  open();
  if (vcd_) guarded([&] { vcd_->show_all(2 * (run_began_ + cycles()) + 1); });
}

// Where the window ends with a segment, the SystemC sequencer sleeps from that edge on, and shows it.
void EngineWave::clock() {
  const int segment = array_.segment();
  array_.step();
  now_ = run_began_ + cycles();
  const bool asleep = request_.in_cycles && total_ + cycles() >= request_.last && array_.beat() == 0;
  guarded([&] { vcd_->edge(2 * now_, segment, asleep); });
  if (!vcd_ || cycles() % 1000 != 0 || !disk_nearly_full(request_)) return;
  close(2 * now_ + 1);
  trouble_ = early_end_text(request_);
}

void EngineWave::ran(const engine::Engine& array, bool aborted) {
  const spec::Relaxation& result = array.result();
  now_ = run_began_ + result.cycles;
  total_ += result.cycles;
  if (!stepped_) return;
  if (aborted) {
    vcd_.reset();
    done_ = true;
    trouble_ = request_.file + ": no wave of a run that was aborted";
    return;
  }
  std::vector<std::uint32_t> outputs(array.topology().neurons());
  array.read_outputs(0, outputs.data(), outputs.size());
  bool same = cycles() == result.cycles && array_.result().sweeps == result.sweeps;
  for (std::size_t k = 0; k < outputs.size(); ++k)
    same = same && outputs[k] == static_cast<std::uint32_t>(array_.state(k));
  if (!same) throw std::logic_error("the engine and its clock-stepped twin disagree");
}

void EngineWave::irq(bool level, std::uint64_t bus) {
  if (level == irq_) return;
  irq_ = level;
  if (vcd_) guarded([&] { vcd_->irq(2 * (now_ + bus - bus_), level); });
}

} // namespace hopmesh::levels
