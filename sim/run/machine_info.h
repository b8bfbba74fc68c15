// What an array costs, in figures: silicon, and the time of a step by formula.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"
#include "sim/machine/timeline.h"
#include "sim/pictures/run_view.h"
#include "sim/scene/scene.h"

namespace hopmesh::run {

using FigureTable = std::pair<std::string, std::vector<pictures::Figure>>;

/// How much a step asks of the array: runs, one an expansion, and the sweeps of all of them together.
struct StepLoad {
  std::uint64_t runs = 1, sweeps = 0;
};
/// A step whose runs end at the scene's limit.
StepLoad longest_step(const scene::Scene& scene);

FigureTable step_time_table(const spec::ArraySpec& array, const spec::Topology& topology,
                            const StepLoad& step);
FigureTable memory_table(const spec::ArraySpec& array, const spec::Topology& topology);
FigureTable multiplier_table(const spec::ArraySpec& array, const spec::Topology& topology);

/// The array as the machine that one would build, as SVG. Throws files::WriteError.
void write_machine_picture(const spec::ArraySpec& array, const spec::Topology& topology,
                           const std::string& scene, const std::string& file);

/// "8.1 % of the array's cycles, 6.2 % of array and bus".
std::string utilisation_text(const machine::Timeline& timeline);

} // namespace hopmesh::run
