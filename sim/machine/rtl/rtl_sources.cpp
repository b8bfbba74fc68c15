#include "sim/machine/rtl/rtl_sources.h"

#include <stdexcept>

namespace hopmesh::machine {

const std::string& rtl_source(const std::string& name) {
  for (const auto& [known, text] : rtl_sources())
    if (known == name) return text;
  throw std::logic_error("no RTL source " + name);
}

bool is_rtl_module(const std::string& name) {
  return name.rfind("hm_", 0) == 0 && name.size() > 2 && name.substr(name.size() - 2) == ".v";
}

} // namespace hopmesh::machine
