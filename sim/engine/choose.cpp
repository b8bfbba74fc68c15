#include "sim/engine/choose.h"

#include "sim/engine/fast_core.h"

#include <stdexcept>

namespace hopmesh::engine {

const std::vector<std::string>& kernel_names() {
  static const std::vector<std::string> names{"auto", "generic", "portable", "avx2", "avx512"};
  return names;
}

std::unique_ptr<Core> make_core(const Plan& plan, const Layout& layout, const std::string& name) {
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

std::size_t threads_for(const spec::Topology&, std::size_t asked) {
  return std::max<std::size_t>(asked, 1);
}

std::size_t chunk_cells(const spec::Topology&, spec::Schedule, std::size_t followed) {
  return followed > 1 ? 1 : 0;
}

std::size_t sweeps_to_follow(std::size_t asked) {
  return std::max<std::size_t>(asked, 1);
}

} // namespace hopmesh::engine
