#include "sim/engine/engine.h"

#include "sim/engine/choose.h"
#include "sim/engine/overflow.h"
#include "sim/engine/row_walk.h"

namespace hopmesh::engine {

Engine::Engine(const spec::ArraySpec& array, const spec::Topology& topology, const Options& options)
    : array_(array), topology_(topology), phases_of_sweep_(spec::phases_of(topology, array.schedule)),
      cycles_(spec::cycle_model(array, topology, phases_of_sweep_)), plan_(array, topology),
      layout_(topology, phases_of_sweep_, array.schedule,
              chunk_cells(topology, array.schedule, options.followed)),
      rule_(spec::has_momentum(array) ? static_cast<std::size_t>(array.momentum_entries) : 0),
      core_(make_core(plan_, layout_, options.kernel)),
      sweeper_(*core_, layout_, rule_, std::max<std::size_t>(options.threads, 1),
               sweeps_to_follow(topology, options.followed)) {}

std::string Engine::why_no_kernel() const {
  return why_generic(plan_);
}

std::pair<std::size_t, std::size_t> Engine::place(std::size_t neuron) const {
  const auto per_cell = static_cast<std::size_t>(topology_.neurons_per_cell);
  return {layout_.slot_of_cell[neuron / per_cell], neuron % per_cell};
}

void Engine::write_weights(std::size_t first, const std::uint32_t* words, std::size_t count) {
  std::vector<std::int32_t> codes(plan_.most_taps);
  walk_rows(topology_, first, count,
            [&](std::size_t cell, std::size_t p, std::size_t tap, std::size_t piece) {
              for (std::size_t k = 0; k < piece; ++k) codes[k] = kept_bits(words[k], plan_.formats.weight);
              core_->put_weights(layout_.slot_of_cell[cell], p, tap, codes.data(), piece);
              words += piece;
            });
}

void Engine::read_weights(std::size_t first, std::uint32_t* words, std::size_t count) const {
  walk_rows(topology_, first, count,
            [&](std::size_t cell, std::size_t p, std::size_t tap, std::size_t piece) {
              for (std::size_t k = 0; k < piece; ++k)
                *words++ = static_cast<std::uint32_t>(core_->weight(layout_.slot_of_cell[cell], p, tap + k));
            });
}

void Engine::write_biases(std::size_t first, const std::uint32_t* words, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const auto [slot, p] = place(first + k);
    core_->put_bias(slot, p, kept_bits(words[k], plan_.formats.bias));
  }
}

void Engine::read_biases(std::size_t first, std::uint32_t* words, std::size_t count) const {
  for (std::size_t k = 0; k < count; ++k) {
    const auto [slot, p] = place(first + k);
    words[k] = static_cast<std::uint32_t>(core_->bias(slot, p));
  }
}

void Engine::write_outputs(std::size_t first, const std::uint32_t* words, std::size_t count) {
  const auto one = static_cast<std::int32_t>(plan_.one_state);
  for (std::size_t k = 0; k < count; ++k) {
    const auto [slot, p] = place(first + k);
    core_->put_state(slot, p, std::min(std::max(kept_bits(words[k], plan_.formats.state), -one), one));
  }
}

void Engine::read_outputs(std::size_t first, std::uint32_t* words, std::size_t count) const {
  for (std::size_t k = 0; k < count; ++k) {
    const auto [slot, p] = place(first + k);
    words[k] = static_cast<std::uint32_t>(core_->state(slot, p));
  }
}

void Engine::write_momentum(std::size_t first, const std::uint32_t* words, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k)
    rule_.table()[first + k] = kept_bits(words[k], spec::momentum_format);
}

void Engine::read_momentum(std::size_t first, std::uint32_t* words, std::size_t count) const {
  for (std::size_t k = 0; k < count; ++k) words[k] = static_cast<std::uint32_t>(rule_.table()[first + k]);
}

void Engine::begin_run(std::uint32_t threshold, std::uint32_t max_sweeps, const spec::StopRule& rule) {
  rule_.begin(threshold, rule);
  max_sweeps_ = std::max(max_sweeps, 1u);
  result_ = {};
  sweeper_.prepare();
}

bool Engine::advance(const std::atomic<bool>& stop, std::uint32_t most) {
  const std::uint32_t end = std::min(max_sweeps_, most);
  if (result_.sweeps >= end) return result_.converged || result_.sweeps == max_sweeps_;
  SweepResult swept;
  result_.sweeps += sweeper_.relax(end - result_.sweeps, stop, swept);
  extremes_.merge(swept.extremes);
  result_.largest_change = static_cast<std::uint32_t>(swept.detected.largest_change);
  result_.largest_sum = static_cast<std::uint64_t>(swept.detected.largest_sum);
  result_.converged = swept.over;
  result_.cycles = cycles_.run(result_.sweeps);
  return result_.converged || result_.sweeps == max_sweeps_;
}

spec::Relaxation Engine::run(std::uint32_t threshold, std::uint32_t max_sweeps, const spec::StopRule& rule) {
  static const std::atomic<bool> never{false};
  begin_run(threshold, max_sweeps, rule);
  advance(never);
  return result_;
}

} // namespace hopmesh::engine
