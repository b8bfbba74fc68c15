// Sweep by sweep, phase by phase, neuron by neuron: nothing is shared, kept or skipped for speed.
#include "tests/support/slow_array.h"

#include "tests/support/slow_fold.h"
#include "tests/support/slow_neuron.h"

namespace hopmesh::tests {
namespace {

/// What the array keeps of a bus word: the low bits of the format, sign extended.
std::int64_t kept_code(std::int32_t word, const spec::NumberFormat& format) {
  return bring_into_range(magnitude_of(word), false, word < 0,
                          {format.width, format.integer_bits, spec::Rounding::trn, spec::Overflow::wrap});
}

class SlowArray {
 public:
  explicit SlowArray(const ArrayJob& job)
      : job_(job), accumulator_(spec::accumulator_format(job.array, job.topology.most_taps())) {
    const std::int64_t one = std::int64_t{1} << job.array.formats.state.fraction_bits();
    for (std::int32_t word : job.start) {
      const std::int64_t v = kept_code(word, job.array.formats.state);
      state_.push_back(v > one ? one : v < -one ? -one : v);
      link_.push_back(link_code(job.array.formats, state_.back()));
    }
    ahead_ = state_;
    moved_.assign(state_.size(), 0);
    for (std::int32_t word : job.momentum) table_.push_back(kept_code(word, spec::momentum_format));
  }

  struct Largest {
    std::int64_t change = 0;
    std::uint64_t sum = 0; ///< of the neurons that may still move
  };

  Largest sweep(const spec::Phases& phases) {
    largest_ = {};
    agreement_ = 0;
    for (const auto& phase : phases) {
      const std::vector<std::int64_t> before = link_; // what everybody in this phase reads
      for (std::uint32_t neuron : phase) fire(neuron, before);
    }
    if (!table_.empty()) check();
    return largest_;
  }

  std::vector<std::int32_t> output() const { return {state_.begin(), state_.end()}; }

 private:
  void fire(std::uint32_t neuron, const std::vector<std::int64_t>& before) {
    const spec::Topology& t = job_.topology;
    const std::uint32_t cell = neuron / t.neurons_per_cell, p = neuron % t.neurons_per_cell;
    std::vector<std::int64_t> weight, link;
    std::vector<std::uint32_t> sources{cell};
    sources.insert(sources.end(), t.link_to.begin() + t.first_link[cell],
                   t.link_to.begin() + t.first_link[cell + 1]);
    for (std::uint32_t source : sources)
      for (int q = 0; q < t.neurons_per_cell; ++q) {
        const std::int32_t word = job_.weight[t.row_offset(cell, p) + weight.size()];
        weight.push_back(kept_code(word, job_.array.formats.weight));
        link.push_back(before[source * t.neurons_per_cell + q]);
      }
    const std::int64_t bias = kept_code(job_.bias[neuron], job_.array.formats.bias);
    const std::int64_t s = accumulate(job_.array, accumulator_, weight, link, bias);
    note_sum(s, before[neuron]);
    move(neuron, s, drive(job_.array, accumulator_, s, divisor(job_.array, weight, p, bias)));
  }

  /// Of a neuron that may still move; `shown`: what links showed of it as s was summed.
  void note_sum(std::int64_t s, std::int64_t shown) {
    const std::int64_t one = std::int64_t{1} << job_.array.formats.link.fraction_bits();
    const bool held = (shown == one && s >= 0) || (shown == -one && s <= 0);
    if (!held) largest_.sum = std::max(largest_.sum, static_cast<std::uint64_t>(magnitude_of(s)));
  }

  void move(std::uint32_t neuron, std::int64_t s, std::int64_t u) {
    const spec::Formats& f = job_.array.formats;
    const bool momentum = job_.array.output == spec::Output::momentum;
    const std::int64_t before = state_[neuron], from = momentum ? ahead_[neuron] : before;
    std::int64_t& after = state_[neuron];
    if (momentum || job_.array.output == spec::Output::projected)
      after = stepped(f, from, u);
    else
      after += change(f, before, u);
    moved_[neuron] = after - before;
    link_[neuron] = link_code(f, after);
    largest_.change = std::max(largest_.change, moved_[neuron] < 0 ? -moved_[neuron] : moved_[neuron]);
    agreement_ += s > 0 ? moved_[neuron] : s < 0 ? -moved_[neuron] : 0;
  }

  /// Behind a sweep with momentum: neurons see where their moves lead, or, after a restart, where they are.
  void check() {
    const bool restart = agreement_ < 0;
    const std::int64_t m = table_[entry_];
    for (std::size_t i = 0; i < state_.size(); ++i) {
      ahead_[i] = restart ? state_[i] : looked_ahead(job_.array.formats, state_[i], moved_[i], m);
      link_[i] = link_code(job_.array.formats, ahead_[i]);
    }
    if (restart) entry_ = 0;
    if (entry_ + 1 < table_.size()) entry_ += 1;
  }

  const ArrayJob& job_;
  spec::NumberFormat accumulator_;
  std::vector<std::int64_t> state_, link_;
  std::vector<std::int64_t> ahead_, moved_, table_; ///< Y; of V in this sweep; m
  std::size_t entry_ = 0;
  Largest largest_;
  std::int64_t agreement_ = 0; ///< moves of this sweep, counted along their sums
};

std::uint64_t groups(std::size_t taps, int lanes) {
  std::uint64_t n = 0;
  for (std::size_t done = 0; done < taps; done += lanes) ++n;
  return n;
}

} // namespace

std::uint64_t slow_cycles(const ArrayJob& job, std::uint32_t sweeps) {
  const spec::ArraySpec& a = job.array;
  const spec::Topology& t = job.topology;
  if (a.elements > 0) {
    std::uint64_t folded = 1;
    for (std::uint64_t phase : slow_folded_sweep(job).phases) folded += phase;
    return 1 + slow_folded_prepare(job) + sweeps * folded;
  }
  const bool binary = a.output == spec::Output::binary;
  const bool reciprocal = !binary && a.normaliser == spec::Normaliser::reciprocal;
  const bool prescaled = !binary && a.normaliser == spec::Normaliser::prescaled;
  std::uint64_t sweep = 1, longest = 0;
  for (const auto& phase : spec::phases_of(t, a.schedule)) {
    std::uint64_t row = 0;
    for (std::uint32_t neuron : phase)
      row = std::max(row, groups(t.taps(neuron / t.neurons_per_cell), a.lanes));
    sweep += row + slow_stage(a);
    longest = std::max(longest, row);
  }
  const std::uint64_t prepare = binary || prescaled ? 0 : longest + (reciprocal ? a.reciprocal_bits + 1 : 0);
  return 1 + prepare + sweeps * sweep;
}

ArrayResult run_slow_array(const ArrayJob& job, Keep keep) {
  SlowArray array(job);
  const spec::Phases phases = spec::phases_of(job.topology, job.array.schedule);
  ArrayResult result;
  std::uint64_t first = 0;
  while (!result.converged && (result.sweeps == 0 || result.sweeps < job.max_sweeps)) {
    const auto [change, sum] = array.sweep(phases);
    result.sweeps += 1;
    result.largest_change = static_cast<std::uint32_t>(change);
    result.largest_sum = job.rule.by_sum ? sum : 0;
    if (result.sweeps == 1) first = sum;
    const std::uint64_t share = job.rule.share == 0 ? 0 : first >> job.rule.share;
    result.converged =
        job.rule.by_sum ? sum <= std::max(job.rule.floor, share) : result.largest_change <= job.threshold;
    if (keep == Keep::last_sweep) result.history.clear();
    result.history.push_back(array.output());
  }
  result.cycles = slow_cycles(job, result.sweeps);
  return result;
}

} // namespace hopmesh::tests
