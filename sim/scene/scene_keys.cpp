// The table of a scene put together, and the one kind of value that is a scene's own: pins.
#include "sim/scene/scene.h"

namespace hopmesh::scene {

namespace {

Pin read_pin(const input::TomlSource& source, const input::TomlValue& item) {
  const std::string key = "mesh.pinned", expected = input::one_of(pin_names) + ", or a node number";
  if (const auto* number = item.as<std::int64_t>()) {
    if (*number >= 0) return *number;
  } else if (const auto* name = item.as<std::string>()) {
    for (const std::string& valid : pin_names)
      if (*name == valid) return *name;
    throw source.error(item, key, expected, input::nearest_name(*name, pin_names));
  }
  throw source.error(item, key, expected);
}

std::vector<Pin> read_pins(const input::TomlSource& source, const input::TomlValue& value) {
  const auto* items = value.as<std::vector<input::TomlValue>>();
  if (!items) return {read_pin(source, value)};
  std::vector<Pin> pins;
  for (const input::TomlValue& item : *items) pins.push_back(read_pin(source, item));
  return pins;
}

std::string pin_text(Pin pin) {
  if (auto* name = std::get_if<std::string>(&pin)) return input::value_text(name);
  return std::to_string(std::get<std::int64_t>(pin));
}

std::string pins_text(const std::vector<Pin>& pins) {
  std::string text;
  for (const Pin& pin : pins) text += (text.empty() ? "" : ", ") + pin_text(pin);
  return '[' + text + ']';
}

} // namespace

input::Special pin_list(std::vector<Pin>& pins) {
  return {[&pins](const auto& source, const auto& value) { pins = read_pins(source, value); },
          [&pins] { return pins_text(pins); }};
}

input::Keys scene_keys(Scene& s) {
  input::Keys all{input::Key("name", &s.name, input::in_words("a name in quotes"),
                             "of the scene, its title and its results folder (a slash becomes a dash there)")
                      .unset_is("the file's name")
                      .allows("a line of text")};
  for (const input::Keys& some : {shape_keys(s.mesh), spring_keys(s.mesh), node_keys(s.mesh),
                                  motion_keys(s.motion, s.probe, s.incremental, s.relax, s.rival),
                                  force_keys(s.force, moving(s.motion, s.incremental)), host_keys(s.host)})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

} // namespace hopmesh::scene
