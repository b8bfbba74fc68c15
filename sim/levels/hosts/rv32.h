// The emulated host, in builds that have one.
#pragma once

#include "sim/levels/hosts/step_host.h"

namespace hopmesh::levels {

/// Compiler, library and emulator were there when this program was built.
bool has_rv32_host();
/// Null where there is none.
std::unique_ptr<StepHost> make_rv32_host(const scene::HostSpec& host, const HostPlace& place);

} // namespace hopmesh::levels
