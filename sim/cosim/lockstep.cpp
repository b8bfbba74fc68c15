#include "sim/cosim/lockstep.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

// What every array made of one more sweep; true while all agree.
bool one_sweep(const Arrays& arrays, std::vector<SweepBySweep>& walks, const ArrayJob& job, Lockstep& l) {
  const Codes before = l.outputs[0];
  for (std::size_t k = 0; k < arrays.size(); ++k) {
    walks[k].next();
    l.outputs[k] = arrays[k].outputs();
    if (l.outputs[k] == l.outputs[0] || l.where) continue;
    l.other = k;
    l.where = locate(job, l.sweeps + 1, before, l.outputs[0], l.outputs[k]);
  }
  return !l.where;
}

std::string first_unequal(const char* window, const Codes& a, const Codes& b) {
  const auto at = std::mismatch(a.begin(), a.end(), b.begin());
  if (at.first == a.end()) return "";
  return fmt::format("{} word {}: {} and {}", window, at.first - a.begin(), *at.first, *at.second);
}

} // namespace

Lockstep run_in_lockstep(const Arrays& arrays, const ArrayJob& job, std::uint32_t sweeps) {
  Lockstep l;
  std::vector<SweepBySweep> walks;
  for (const BusArray& array : arrays) {
    walks.emplace_back(array, job);
    l.outputs.push_back(array.outputs());
  }
  while (l.sweeps < sweeps && one_sweep(arrays, walks, job, l)) l.sweeps += 1;
  return l;
}

std::optional<Divergence> part_from_start(const Arrays& two, const ArrayJob& job, std::uint32_t sweeps) {
  Codes before = job.start;
  std::vector<SweepBySweep> walks;
  for (const BusArray& array : two) walks.emplace_back(array, job, SweepBySweep::Each::from_the_start);
  for (std::uint32_t sweep = 1; sweep <= sweeps; ++sweep) {
    Codes after[2];
    for (std::size_t k = 0; k < 2; ++k) {
      walks[k].next();
      after[k] = two[k].outputs();
    }
    if (after[0] != after[1]) return locate(job, sweep, before, after[0], after[1]);
    before = std::move(after[0]);
  }
  return std::nullopt;
}

std::string memory_difference(const Arrays& two, const ArrayJob& job) {
  std::string text = first_unequal("WEIGHT", two[0].weights(), two[1].weights());
  if (text.empty()) text = first_unequal("BIAS", two[0].biases(), two[1].biases());
  const std::size_t entries = job.momentum.size();
  if (text.empty() && entries > 0)
    text = first_unequal("MOMENTUM", two[0].momentum(entries), two[1].momentum(entries));
  return text;
}

} // namespace hopmesh::cosim
