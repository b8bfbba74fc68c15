// Cycle by cycle: rounds are summed, sums leave, neurons walk through their stages.
#include "tests/support/slow_fold.h"

#include <algorithm>

namespace hopmesh::tests {
namespace {

using cosim::ArrayJob;
using Round = std::vector<std::uint32_t>; ///< neurons, element by element

std::uint64_t row_cycles(const ArrayJob& job, std::uint32_t neuron) {
  const std::size_t taps = job.topology.taps(neuron / job.topology.neurons_per_cell);
  std::uint64_t cycles = 0;
  for (std::size_t done = 0; done < taps; done += static_cast<std::size_t>(job.array.lanes)) cycles += 1;
  return cycles;
}

// The neuron with the longest row is taken out again and again; of several, the one of the lowest number.
std::vector<Round> rounds_of(const ArrayJob& job, std::vector<std::uint32_t> phase) {
  const auto taps = [&](std::uint32_t i) { return job.topology.taps(i / job.topology.neurons_per_cell); };
  std::vector<Round> rounds;
  for (int element = 0; !phase.empty(); element = (element + 1) % job.array.elements) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < phase.size(); ++k)
      if (taps(phase[k]) > taps(phase[longest])) longest = k;
    if (element == 0) rounds.emplace_back();
    rounds.back().push_back(phase[longest]);
    phase.erase(phase.begin() + static_cast<std::ptrdiff_t>(longest));
  }
  return rounds;
}

/// Calls enters(neuron, cycle) with the first cycle of each neuron in its stage. `depth`: of that stage.
template <typename Enters>
void step_through(const ArrayJob& job, const std::vector<Round>& rounds, std::uint64_t depth,
                  const Enters& enters) {
  const bool one = job.array.stages == spec::Stages::one;
  std::uint64_t cycle = 1, busy = 0; // cycle 0 has read the memories; busy: cycles until the next may go in
  std::size_t r = 0, waiting = 0;    // waiting: sums of round r - 1 in hold registers
  std::uint64_t left = row_cycles(job, rounds[0][0]);
  for (; r < rounds.size() || waiting > 0; ++cycle) {
    if (waiting > 0) {
      const Round& held = rounds[r - 1];
      enters(held[held.size() - waiting], cycle);
      waiting -= 1;
    }
    if (busy > 0) busy -= 1;
    if (left > 0) left -= 1;
    if (r == rounds.size() || left > 0 || busy > 0 || waiting > 0) continue;
    if (one)
      waiting = rounds[r].size();
    else
      for (std::uint32_t neuron : rounds[r]) enters(neuron, cycle + 1);
    busy = one ? 0 : depth;
    r += 1;
    left = r < rounds.size() ? row_cycles(job, rounds[r][0]) : 0;
  }
}

} // namespace

std::uint64_t slow_stage(const spec::ArraySpec& a) {
  if (a.output == spec::Output::binary) return 2;
  const int quotient = a.formats.drive.fraction_bits() + (a.output == spec::Output::projected ? 3 : 2);
  const int normalise = a.normaliser == spec::Normaliser::prescaled    ? 1
                        : a.normaliser == spec::Normaliser::reciprocal ? 2
                                                                       : quotient;
  const int output = a.output == spec::Output::projected ? 1 : 2;
  return static_cast<std::uint64_t>(normalise + output + a.pipeline);
}

SlowSweep slow_folded_sweep(const ArrayJob& job) {
  SlowSweep sweep;
  sweep.written.resize(job.topology.neurons());
  const std::uint64_t stage = slow_stage(job.array);
  std::uint64_t before = 0;
  for (const auto& phase : spec::phases_of(job.topology, job.array.schedule)) {
    std::uint64_t end = 0;
    step_through(job, rounds_of(job, phase), stage, [&](std::uint32_t neuron, std::uint64_t enters) {
      sweep.written[neuron] = before + enters + stage;
      end = std::max(end, enters + stage);
    });
    sweep.phases.push_back(end);
    before += end;
  }
  return sweep;
}

std::uint64_t slow_folded_prepare(const ArrayJob& job) {
  const spec::ArraySpec& a = job.array;
  if (a.output == spec::Output::binary || a.normaliser == spec::Normaliser::prescaled) return 0;
  std::vector<Round> all;
  for (const auto& phase : spec::phases_of(job.topology, a.schedule))
    for (Round& round : rounds_of(job, phase)) all.push_back(std::move(round));
  std::uint64_t depth = a.stages == spec::Stages::one ? 1 : 0, end = 0;
  if (a.normaliser == spec::Normaliser::reciprocal) depth = static_cast<std::uint64_t>(a.reciprocal_bits) + 1;
  step_through(job, all, depth,
               [&](std::uint32_t, std::uint64_t enters) { end = std::max(end, enters + depth); });
  return end;
}

} // namespace hopmesh::tests
