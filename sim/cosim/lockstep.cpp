#include "sim/cosim/lockstep.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

// What every array made of one more sweep; true while all agree.
bool one_sweep(const std::vector<BusArray>& arrays, const ArrayJob& job, Lockstep& l) {
  const Codes before = l.outputs[0];
  for (std::size_t k = 0; k < arrays.size(); ++k) {
    arrays[k].one_sweep();
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

Lockstep run_in_lockstep(const Buses& buses, const ArrayJob& job, std::uint32_t sweeps) {
  std::vector<BusArray> arrays;
  for (const hm_bus* bus : buses) arrays.emplace_back(*bus, job.topology);
  Lockstep l;
  for (const BusArray& array : arrays) {
    array.put_outputs(job.start);
    l.outputs.push_back(array.outputs());
  }
  while (l.sweeps < sweeps && one_sweep(arrays, job, l)) l.sweeps += 1;
  return l;
}

std::optional<Divergence> part_from_start(const Buses& two, const ArrayJob& job, std::uint32_t sweeps) {
  const BusArray a(*two[0], job.topology), b(*two[1], job.topology);
  Codes before = job.start;
  for (std::uint32_t sweep = 1; sweep <= sweeps; ++sweep) {
    Codes after[2];
    for (int k = 0; k < 2; ++k) {
      const BusArray& array = k == 0 ? a : b;
      array.put_outputs(job.start);
      array.run(job.threshold, sweep);
      after[k] = array.outputs();
    }
    if (after[0] != after[1]) return locate(job, sweep, before, after[0], after[1]);
    before = std::move(after[0]);
  }
  return std::nullopt;
}

std::string memory_difference(const Buses& two, const spec::Topology& topology) {
  const BusArray a(*two[0], topology), b(*two[1], topology);
  const std::string weights = first_unequal("WEIGHT", a.weights(), b.weights());
  return weights.empty() ? first_unequal("BIAS", a.biases(), b.biases()) : weights;
}

} // namespace hopmesh::cosim
