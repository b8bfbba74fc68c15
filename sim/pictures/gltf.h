// mesh.glb: the motion as one animated glTF 2.0 file that any viewer opens.
#pragma once

#include "sim/pictures/run_view.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace hopmesh::pictures {

/// Morph targets cost memory in every viewer: at most this many frames are kept, picked evenly, first and
/// last among them.
constexpr std::size_t glb_frames_at_most = 60;
/// Of all frames together, places and normals; a large mesh keeps fewer frames, but two at least.
constexpr std::size_t glb_frame_bytes_at_most = 64u << 20;

/// How many frames a mesh of so many nodes may keep.
std::size_t glb_frames_of(std::size_t nodes);

/// The frames write_glb keeps: evenly picked, and only such as have a finite place for every node and a later
/// time.
std::vector<std::size_t> frames_for_glb(const RunView& view);

/// Without triangles the springs are drawn as lines. Throws WriteError if the file cannot be written or no
/// frame is finite.
void write_glb(const RunView& view, const std::filesystem::path& path);

} // namespace hopmesh::pictures
