// Which arrays the Verilog of rtl_model/verilog can be.
#pragma once

#include "rtl_model/spec/array_rules.h"

namespace hopmesh::machine {

/// Nothing for an array that the RTL covers, else the key that it does not, and what it would cover. The
/// array must have passed spec::validate_on.
std::optional<spec::SpecFault> rtl_fault(const spec::ArraySpec& array, const spec::Topology& topology);

} // namespace hopmesh::machine
