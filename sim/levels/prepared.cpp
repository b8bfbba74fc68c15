#include "sim/levels/prepared.h"

#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/schedule.h"
#include "sim/input/count_text.h"
#include "sim/levels/image_force.h"

#include <fmt/format.h>

namespace hopmesh::levels {

void tell_of_fold(const spec::ArraySpec& array, const spec::Topology& topology,
                  std::vector<std::string>& notes) {
  const auto elements = static_cast<std::size_t>(array.elements);
  if (elements <= 1) return;
  std::size_t most = 0;
  for (const auto& phase : spec::phases_of(topology, array.schedule)) most = std::max(most, phase.size());
  if (elements <= most) return;
  notes.push_back(fmt::format(
      "array.elements: {} elements never work: {} are more than the {} of the largest phase",
      input::grouped(elements - most), input::grouped(elements), input::with_noun(most, "neuron")));
}

Prepared prepare(const std::string& scene, const std::string& array,
                 const std::vector<std::string>& overrides) {
  Prepared p{scene::read_inputs(scene, array, overrides), nullptr};
  p.mesh = std::make_unique<BuiltMesh>(p.inputs.scene);
  for (const std::string& note : p.mesh->mesh().notes) p.inputs.notes.push_back(note);
  if (p.inputs.scene.force.image) tell_of_picture(p.inputs.scene, p.inputs.notes);
  if (const auto fault = spec::validate_on(p.inputs.array, p.mesh->topology()))
    throw input::input_error(array, 0, fault->key, fault->found, fault->expected);
  tell_of_fold(p.inputs.array, p.mesh->topology(), p.inputs.notes);
  return p;
}

} // namespace hopmesh::levels
