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
  }

  /// A sweep; returns the largest |Delta V|.
  std::int64_t sweep(const spec::Phases& phases) {
    std::int64_t largest = 0;
    for (const auto& phase : phases) {
      const std::vector<std::int64_t> before = link_; // what everybody in this phase reads
      for (std::uint32_t neuron : phase) {
        const std::int64_t moved = fire(neuron, before);
        largest = std::max(largest, moved < 0 ? -moved : moved);
      }
    }
    return largest;
  }

  std::vector<std::int32_t> output() const { return {state_.begin(), state_.end()}; }

 private:
  std::int64_t fire(std::uint32_t neuron, const std::vector<std::int64_t>& before) {
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
    const std::int64_t u = drive(job_.array, accumulator_, s, row_sum(job_.array, weight, bias));
    const std::int64_t moved = change(job_.array.formats, state_[neuron], u);
    state_[neuron] += moved;
    link_[neuron] = link_code(job_.array.formats, state_[neuron]);
    return moved;
  }

  const ArrayJob& job_;
  spec::NumberFormat accumulator_;
  std::vector<std::int64_t> state_, link_;
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
  while (!result.converged && (result.sweeps == 0 || result.sweeps < job.max_sweeps)) {
    result.largest_change = static_cast<std::uint32_t>(array.sweep(phases));
    result.sweeps += 1;
    result.converged = result.largest_change <= job.threshold;
    if (keep == Keep::last_sweep) result.history.clear();
    result.history.push_back(array.output());
  }
  result.cycles = slow_cycles(job, result.sweeps);
  return result;
}

} // namespace hopmesh::tests
