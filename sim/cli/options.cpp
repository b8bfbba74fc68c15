#include "sim/cli/options.h"

#include "sim/input/standard_streams.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace hopmesh::cli {

int exit_of(run::Outcome outcome) {
  if (outcome == run::Outcome::interrupted) return interrupted;
  return outcome == run::Outcome::finished ? done : differs;
}

void add_common(CLI::App& verb, input::InputWords& words) {
  verb.add_option("SCENE", words.scene, "a scene file, or the name of a shipped scene")->required();
  verb.add_option("--array", words.array, "an array file, or the name of a preset")->group("Scene and array");
  verb.add_option("--set", words.overrides, "key.path=value: overrides a key of the scene or the array")
      ->allow_extra_args(false)
      ->group("Scene and array");
}

void tell(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) input::say(fmt::format("hopmesh: note: {}\n", note));
}

levels::Prepared prepare(const input::InputWords& words) {
  levels::Prepared prepared = levels::prepare(words.scene, words.array, words.overrides);
  tell(prepared.inputs.notes);
  return prepared;
}

void check_step(std::int64_t step, const levels::Prepared& prepared) {
  const std::int64_t steps = prepared.inputs.scene.motion.steps;
  if (step >= steps)
    throw input::input_error("", 0, "--step", std::to_string(step),
                             fmt::format("0 to {} (the scene's steps)", steps - 1));
}

std::filesystem::path results_folder(const std::string& out, std::string name) {
  if (!out.empty()) return out;
  std::replace(name.begin(), name.end(), '/', '-');
  return "out/" + (name == "." || name == ".." ? "scene" : name);
}

std::size_t workers_of(std::int64_t asked) {
  return asked > 0 ? static_cast<std::size_t>(asked) : std::max(1u, std::thread::hardware_concurrency());
}

} // namespace hopmesh::cli
