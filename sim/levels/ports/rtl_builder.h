// Models of the RTL, made by Verilator and the compiler when they are first asked for, and kept in a cache.
#pragma once

#include "sim/levels/ports/rtl_model.h"
#include "sim/machine/rtl/rtl_parameters.h"

#include <string>

namespace hopmesh::levels {

enum class RtlBuild {
  when_missing, ///< with a line on stderr, as it takes a while
  never         ///< only what is kept
};

/// A loaded model of the array with that room. Null where nothing is kept and nothing may be built. Throws
/// input::InputError where Verilator or the compiler is absent, std::runtime_error for whatever else fails:
/// one line each. Two processes that ask for the same model at once build it once.
const RtlLibrary* rtl_library(const spec::ArraySpec& array, const machine::RtlRoom& room, RtlBuild build);

/// Where models are kept: HOPMESH_CACHE, or hopmesh in XDG_CACHE_HOME, or in ~/.cache.
std::filesystem::path rtl_cache();

} // namespace hopmesh::levels
