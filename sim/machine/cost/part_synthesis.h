// The parts of a design, each synthesised by yosys alone, with its memories left out: cells of ECP5 and
// iCE40, and cells of OSU's 0.18 um library, weighed by OpenSTA.
#pragma once

#include "sim/machine/cost/cost_figures.h"
#include "sim/machine/cost/tool_run.h"

#include <map>
#include <set>

namespace hopmesh::machine {

enum class Target { ecp5, ice40, osu018 };
inline constexpr std::array<const char*, 3> target_names{"ecp5", "ice40", "osu018"};

struct Synthesis {
  std::array<PartFigures, 3> parts; ///< by Part; NaN where a tool is missing or failed
  bool without_dsp = false;         ///< yosys died of iCE40's multipliers, so there are none in these figures
  std::vector<std::string> failed;  ///< "stage, ice40": what no figure came of
};

/// `design`: a folder that hopmesh rtl wrote; tools leave their files in its folder `cost`. `tell` is called
/// from any thread as parts are done.
Synthesis synthesise_parts(const std::filesystem::path& design, const CostTools& tools,
                           const std::set<Target>& targets, std::size_t workers,
                           const std::function<void(const std::string&)>& tell);

/// Cells by type from the output of yosys's stat: those of the whole.
std::map<std::string, double> cells_of_stat(const std::string& text);

} // namespace hopmesh::machine
