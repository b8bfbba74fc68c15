#include "sim/engine/choose.h"

#include "sim/engine/generic/generic_core.h"
#include "sim/engine/kernels/fast_core.h"
#include "sim/engine/kernels/kernel_fit.h"

#include <stdexcept>

namespace hopmesh::engine {

const std::vector<std::string>& kernel_names() {
  static const std::vector<std::string> names{"auto", "generic", "portable", "avx2", "avx512"};
  return names;
}

std::string why_generic(const NeuronPlan& plan) {
  return why_no_kernel(plan);
}

std::unique_ptr<SweepCore> make_core(const NeuronPlan& plan, const Layout& layout, const std::string& name) {
  const std::string why_not = why_no_kernel(plan);
  if (name == "generic" || (name == "auto" && !why_not.empty())) return make_generic_core(plan, layout);
  const auto& names = kernel_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw std::invalid_argument("no kernel is called " + name);
  if (!why_not.empty()) throw std::invalid_argument("kernel " + name + " has no way for " + why_not);
  const KernelSet* kernels = kernel_set(name == "auto" ? "" : name);
  if (!kernels) throw std::invalid_argument("this processor cannot run kernel " + name);
  return make_fast_core(plan, layout, *kernels);
}

// A sweep of fewer cells is over before a second thread has come to the barrier.
std::size_t useful_threads(const spec::Topology& topology, std::size_t at_most) {
  constexpr std::size_t cells_a_thread = 2500;
  return std::max<std::size_t>(1, std::min(topology.cells() / cells_a_thread, at_most));
}

// Sweeps follow each other where the network is larger than a cache can be hoped to hold and links are short:
// then what all of them need at a time is a small part of it.
std::size_t sweeps_to_follow(const spec::Topology& topology, std::size_t asked) {
  constexpr std::size_t large = 60'000, most = 16, share = 8;
  if (asked > 0) return asked;
  return topology.cells() >= large && link_reach(topology) * share * most <= topology.cells() ? most : 1;
}

std::size_t chunk_cells(const spec::Topology& topology, spec::Schedule schedule, std::size_t asked) {
  constexpr std::size_t least = 512; // shorter chunks leave lanes empty
  const bool follow = schedule != spec::Schedule::sequential && sweeps_to_follow(topology, asked) > 1;
  return follow ? std::min(least, std::max<std::size_t>(1, topology.cells() / 8)) : 0;
}

} // namespace hopmesh::engine
