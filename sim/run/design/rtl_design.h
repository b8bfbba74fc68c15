// An array as Verilog that stands alone: sources, parameters, tables, a test bench with the scene's own
// traffic, scripts for yosys.
#pragma once

#include "sim/levels/prepared.h"

#include <filesystem>

namespace hopmesh::run {

struct DesignFacts {
  std::size_t files = 0, lines = 0;  ///< lines: of the test bench's script
  std::vector<std::uint64_t> cycles; ///< of each step that it plays
};

/// Writes the design into a folder. The test bench plays the first `steps` steps of the motion. Throws
/// input::InputError for an array that RTL does not cover, files::WriteError.
DesignFacts write_rtl_design(const levels::Prepared& prepared, std::size_t steps,
                             const std::filesystem::path& folder);

} // namespace hopmesh::run
