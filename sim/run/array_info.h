// What a scene makes of an array, in figures: neurons, links, memory, cycles, and what was left out.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "sim/levels/built_mesh.h"
#include "sim/pictures/run_view.h"
#include "sim/scene/scene.h"

namespace hopmesh::run {

using FigureTable = std::pair<std::string, std::vector<pictures::Figure>>;

/// Tables `Array`, `Formats`, `Cycles`, `Memory`, `Left out`, from the descriptions alone: nothing is built.
std::vector<FigureTable> array_info(const scene::Scene& scene, const levels::BuiltMesh& mesh,
                                    const spec::ArraySpec& array);

/// What the array's memories hold, in bits.
struct MemoryBits {
  std::uint64_t weights = 0, biases = 0, states_and_links = 0, accumulators = 0;
  std::uint64_t total() const { return weights + biases + states_and_links + accumulators; }
};
MemoryBits memory_bits(const levels::BuiltMesh& mesh, const spec::ArraySpec& array);

/// What the array's multipliers multiply, in bits times bits: w L in each lane, R u, and s r where the
/// normaliser is a reciprocal.
std::uint64_t multiplier_bits(const levels::BuiltMesh& mesh, const spec::ArraySpec& array);

/// The tables as aligned text.
std::string text_of(const std::vector<FigureTable>& tables);

} // namespace hopmesh::run
