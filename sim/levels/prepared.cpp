#include "sim/levels/prepared.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/levels/image_force.h"

namespace hopmesh::levels {

Prepared prepare(const std::string& scene, const std::string& array,
                 const std::vector<std::string>& overrides) {
  Prepared p{scene::read_inputs(scene, array, overrides), nullptr};
  p.mesh = std::make_unique<BuiltMesh>(p.inputs.scene);
  for (const std::string& note : p.mesh->mesh().notes) p.inputs.notes.push_back(note);
  if (p.inputs.scene.force.image) tell_of_picture(p.inputs.scene, p.inputs.notes);
  if (const auto fault = spec::validate_on(p.inputs.array, p.mesh->topology()))
    throw input::input_error(array, 0, fault->key, fault->found, fault->expected);
  return p;
}

} // namespace hopmesh::levels
