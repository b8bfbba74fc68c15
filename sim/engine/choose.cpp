#include "sim/engine/choose.h"

#include <stdexcept>

namespace hopmesh::engine {

const std::vector<std::string>& kernel_names() {
  static const std::vector<std::string> names{"auto", "generic"};
  return names;
}

std::unique_ptr<Core> make_core(const Plan& plan, const Layout& layout, const std::string& name) {
  if (name != "auto" && name != "generic") throw std::invalid_argument("no kernel is called " + name);
  return make_generic_core(plan, layout);
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
