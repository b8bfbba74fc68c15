// A build without compiler, library or emulator for host.processor = "rv32".
#include "sim/levels/hosts/rv32.h"

namespace hopmesh::levels {

bool has_rv32_host() {
  return false;
}

std::unique_ptr<StepHost> make_rv32_host(const scene::HostSpec&, const HostPlace&) {
  return nullptr;
}

} // namespace hopmesh::levels
