#include "sim/cosim/divergence.h"

namespace hopmesh::cosim {

Timing::Timing(const ArrayJob& job)
    : phases(spec::phases_of(job.topology, job.array.schedule)),
      cycles(spec::cycle_model(job.array, job.topology, phases)), array_(job.array) {
  if (spec::is_folded(array_)) fold_ = spec::fold_of(array_, job.topology, phases);
}

std::uint64_t Timing::published(std::uint64_t sweep, std::size_t phase) const {
  std::uint64_t cycle = cycles.run(sweep - 1);
  for (std::size_t k = 0; k <= phase; ++k) cycle += cycles.phase[k];
  return cycle - 1; // a phase of cycles c ... e publishes in cycle e
}

std::vector<std::pair<std::uint32_t, std::uint64_t>> Timing::publications(std::uint64_t sweep,
                                                                          std::size_t phase) const {
  const std::uint64_t end = published(sweep, phase);
  std::vector<std::pair<std::uint32_t, std::uint64_t>> all;
  if (!fold_)
    for (std::uint32_t neuron : phases[phase]) all.push_back({neuron, end});
  else
    for (const spec::Round& round : fold_->rounds[phase])
      for (std::size_t e = 0; e < round.count; ++e)
        all.push_back({fold_->order[phase][round.first + e],
                       end + 1 - cycles.phase[phase] +
                           spec::through_stage(array_, round, e, spec::stage_cycles(array_))});
  return all;
}

namespace {

// Outputs in the middle of a sweep: phases before k have fired, the others have not.
Codes in_sweep(const spec::Phases& phases, std::size_t k, const Codes& before, const Codes& after) {
  Codes now = before;
  for (std::size_t earlier = 0; earlier < k; ++earlier)
    for (std::uint32_t neuron : phases[earlier]) now[neuron] = after[neuron];
  return now;
}

std::vector<Tap> taps_of(const ArrayJob& job, std::uint32_t neuron, const Codes& outputs) {
  const spec::Topology& t = job.topology;
  const auto n = static_cast<std::size_t>(t.neurons_per_cell);
  const std::size_t cell = neuron / n, row = t.row_offset(cell, neuron % n);
  std::vector<Tap> taps;
  for (std::size_t tap = 0; tap < t.taps(cell); ++tap) {
    const std::size_t source = tap < n ? cell : t.link_to[t.first_link[cell] + tap / n - 1];
    taps.push_back({static_cast<std::uint32_t>(source), static_cast<std::uint32_t>(tap % n),
                    job.weight[row + tap], outputs[source * n + tap % n]});
  }
  return taps;
}

} // namespace

Divergence locate(const ArrayJob& job, std::uint64_t sweep, const Codes& before, const Codes& a,
                  const Codes& b) {
  const Timing timing(job);
  Divergence d;
  d.sweep = sweep;
  for (std::size_t k = 0; k < timing.phases.size(); ++k)
    for (const auto& [neuron, cycle] : timing.publications(sweep, k)) {
      if (a[neuron] == b[neuron]) continue;
      d.phase = k;
      d.cycle = cycle;
      d.neuron = neuron;
      d.raw[0] = a[neuron], d.raw[1] = b[neuron];
      d.before_raw = before[neuron], d.bias_raw = job.bias[neuron];
      d.ahead = spec::has_momentum(job.array);
      d.taps = taps_of(job, neuron, in_sweep(timing.phases, k, before, a));
      return d;
    }
  return d;
}

} // namespace hopmesh::cosim
