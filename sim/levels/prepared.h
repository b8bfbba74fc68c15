// Scene and array, read and checked, with the mesh as built: what every level is made from.
#pragma once

#include "sim/levels/built_mesh.h"
#include "sim/scene/scene_file.h"

#include <memory>

namespace hopmesh::levels {

struct Prepared {
  scene::Inputs inputs;
  std::unique_ptr<BuiltMesh> mesh;
};

/// Adds a line where an array has more elements than any phase has neurons.
void tell_of_fold(const spec::ArraySpec& array, const spec::Topology& topology,
                  std::vector<std::string>& notes);

/// As scene::read_inputs, and the array's rules are checked for this very mesh. Throws input::InputError.
Prepared prepare(const std::string& scene, const std::string& array,
                 const std::vector<std::string>& overrides);

} // namespace hopmesh::levels
