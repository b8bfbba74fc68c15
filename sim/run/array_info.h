// What a scene makes of an array, in figures: neurons, links, memory, cycles, and what was left out.
#pragma once

#include "sim/levels/built_mesh.h"
#include "sim/run/machine_info.h"

namespace hopmesh::run {

/// Tables of motion, array, time and silicon, from the descriptions alone: nothing is built. `step`: the one
/// whose time is told.
std::vector<FigureTable> array_info(const scene::Scene& scene, const levels::BuiltMesh& mesh,
                                    const spec::ArraySpec& array, const StepLoad& step);

/// The tables as aligned text.
std::string text_of(const std::vector<FigureTable>& tables);

} // namespace hopmesh::run
