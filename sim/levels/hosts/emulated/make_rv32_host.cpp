// A build with the emulator: the host that host.processor = "rv32" stands for.
#include "sim/levels/hosts/emulated/rv32_host.h"
#include "sim/levels/hosts/rv32.h"

namespace hopmesh::levels {

std::unique_ptr<StepHost> make_rv32_host(const scene::HostSpec& host, const HostPlace& place) {
  return std::make_unique<Rv32Host>(host, place);
}

bool has_rv32_host() {
  return true;
}

} // namespace hopmesh::levels
