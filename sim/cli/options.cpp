#include "sim/cli/options.h"

#include "sim/files/standard_streams.h"
#include "sim/study/study_points.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cli {

std::string default_folder(std::string name) {
  std::replace(name.begin(), name.end(), '/', '-');
  return "out/" + (name == "." || name == ".." ? "scene" : name);
}

void add_common(CLI::App& verb, CommonOptions& options) {
  verb.add_option("SCENE", options.scene, "a scene file, or the name of a shipped scene")->required();
  verb.add_option("--array", options.array, "an array file, or the name of a preset")
      ->group("Scene and array");
  verb.add_option("--set", options.overrides, "key.path=value: overrides a key of the scene or the array")
      ->allow_extra_args(false)
      ->group("Scene and array");
}

std::string shell_word(const std::string& word) {
  return study::shell_word(word);
}

std::string words_of(const CommonOptions& options) {
  std::string words = shell_word(options.scene);
  if (!options.array.empty()) words += " --array " + shell_word(options.array);
  for (const auto& override : options.overrides) words += " --set " + shell_word(override);
  return words;
}

void tell(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) files::say(fmt::format("hopmesh: note: {}\n", note));
}

levels::Prepared prepare(const CommonOptions& options) {
  levels::Prepared prepared = levels::prepare(options.scene, options.array, options.overrides);
  tell(prepared.inputs.notes);
  return prepared;
}

void check_name(const std::string& name, const std::string& flag, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw input::input_error("", 0, flag, name, fmt::format("{}", fmt::join(names, ", ")),
                             input::nearest_name(name, names));
}

} // namespace hopmesh::cli
