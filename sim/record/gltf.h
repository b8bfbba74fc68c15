// mesh.glb: the motion as one animated glTF 2.0 file that any viewer opens.
#pragma once

#include "sim/record/run_view.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace hopmesh::record {

/// Morph targets cost memory in every viewer: at most this many frames are kept, picked evenly, first and
/// last among them.
constexpr std::size_t glb_frames_at_most = 60;

/// The frames write_glb keeps: evenly picked, and only such as have a finite place for every node and a later
/// time.
std::vector<std::size_t> frames_for_glb(const RunView& view);

/// Without triangles the springs are drawn as lines. Throws WriteError if the file cannot be written or no
/// frame is finite.
void write_glb(const RunView& view, const std::filesystem::path& path);

} // namespace hopmesh::record
