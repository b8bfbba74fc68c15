// Finds the files a run names, deals out its overrides, and reads scene and array.
#include "sim/scene/scene_file.h"

#include "sim/input/array_file.h"
#include "sim/input/shipped.h"
#include "sim/scene/scene_reader.h"

namespace hopmesh::scene {

namespace {

/// A list of m wants an array with a table that has room for it.
void judge_momentum(const input::TomlSource& source, Inputs& inputs) {
  const std::string key = "relax.momentum";
  const std::size_t entries = inputs.scene.relax.momentum.size();
  const auto room = static_cast<std::size_t>(inputs.array.momentum_entries);
  if (entries == 0) return;
  if (!spec::has_momentum(inputs.array))
    inputs.notes.push_back(input::no_effect(source, *source.find(key), key, "array.output = \"momentum\""));
  else if (entries > room)
    throw scene_error(inputs.scene, key, std::to_string(entries) + " numbers",
                      "at most the " + std::to_string(room) + " of array.momentum_entries");
}

/// A correction stands on weights that say the same whatever the bias is, and on outputs between the bounds.
void judge_corrections(const Inputs& inputs) {
  const RelaxSpec& relax = inputs.scene.relax;
  if (!relax.corrects()) return;
  const char* const key = relax.refinements > 0 ? "relax.refinements" : "relax.reload";
  const std::string found =
      relax.refinements > 0 ? std::to_string(relax.refinements) : input::in_quotes("bias");
  if (inputs.array.output == spec::Output::binary)
    throw scene_error(inputs.scene, key, found, "none with array.output = \"binary\": signs have no digits");
  if (inputs.array.normaliser == spec::Normaliser::prescaled)
    throw scene_error(inputs.scene, key, found,
                      "none with array.normaliser = \"prescaled\": its rows are divided by their bias too");
}

} // namespace

Inputs read_inputs(const std::string& scene, const std::string& array,
                   const std::vector<std::string>& overrides) {
  const std::string path = input::path_of(scene, input::Shipped::scene);
  input::TomlSource source = input::TomlSource::read(path, "a scene file");
  std::vector<std::pair<std::string, std::string>> of_array;
  for (const std::string& text : overrides) {
    auto split = input::split_override(text);
    if (input::is_array_key(split.first))
      of_array.push_back(std::move(split));
    else
      override_scene(source, split.first, split.second);
  }
  Inputs inputs{read_scene(source, path), {}};
  Scene fresh;
  inputs.notes = input::without_effect(source, scene_keys(inputs.scene), scene_keys(fresh));
  inputs.array = input::read_array(array, of_array, inputs.notes);
  judge_momentum(source, inputs);
  judge_corrections(inputs);
  return inputs;
}

namespace {

input::TomlSource placed(const PlacedText& text, const std::string& file) {
  return input::TomlSource::of_text(std::string(static_cast<std::size_t>(text.line - 1), '\n') + text.text,
                                    file);
}

} // namespace

Inputs inputs_of(const PlacedText& scene, const PlacedText& array, const std::string& file) {
  return {read_scene(placed(scene, file), file), input::array_of(placed(array, file), file)};
}

} // namespace hopmesh::scene
