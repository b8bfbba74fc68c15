#include "sim/cli/options.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/levels/engine_port.h"
#include "sim/run/progress.h"
#include "sim/levels/rival_motion.h"
#include "sim/levels/systemc_port.h"
#include "sim/engine/choose.h"
#include "sim/study/study_points.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::cli {

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  const auto judge = [=](const std::string& text) {
    std::int64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    if (failure == std::errc() && stop == end && number >= least && number <= most) return std::string();
    return fmt::format("found {}, expected an integer from {} to {}", text, least, most);
  };
  return CLI::Validator(judge, "");
}

CLI::Validator positive_number() {
  const auto judge = [](const std::string& text) {
    double number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    if (failure == std::errc() && stop == end && number > 0 && std::isfinite(number)) return std::string();
    return fmt::format("found {}, expected a number above 0", text);
  };
  return CLI::Validator(judge, "");
}

std::string default_folder(std::string name) {
  std::replace(name.begin(), name.end(), '/', '-');
  return "out/" + (name == "." || name == ".." ? "scene" : name);
}

void add_common(CLI::App& verb, CommonOptions& options) {
  verb.add_option("SCENE", options.scene, "a scene file, or the name of a shipped scene")->required();
  verb.add_option("--array", options.array, "an array file, or the name of a preset");
  verb.add_option("--set", options.overrides, "key.path=value: overrides a key of the scene or the array")
      ->allow_extra_args(false);
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

Prepared prepare(const CommonOptions& options) {
  Prepared p{scene::read_inputs(options.scene, options.array, options.overrides), nullptr};
  p.mesh = std::make_unique<levels::BuiltMesh>(p.inputs.scene);
  if (const auto fault = spec::validate(p.inputs.array, p.mesh->topology().most_taps()))
    throw input::input_error(options.array, 0, fault->key, fault->found, fault->expected);
  return p;
}

const std::vector<std::string>& level_names() {
  static const std::vector<std::string> names{"reference", "engine", "systemc", "systemc-clock"};
  return names;
}

namespace {

std::unique_ptr<levels::ArrayPort> make_engine(const spec::ArraySpec& array, const spec::Topology& topology,
                                              const PortRequest& request) {
  engine::Options useful = request.engine;
  useful.threads = engine::useful_threads(topology, useful.threads);
  auto port = std::make_unique<levels::EnginePort>(array, topology, useful, request.wave, stop_requested);
  const std::string why = port->engine().why_no_kernel();
  if (!why.empty() && !request.quiet)
    fmt::print(stderr, "hopmesh: engine: no fast kernel for {}; the generic path computes this array\n", why);
  return port;
}

} // namespace

std::unique_ptr<levels::ArrayPort> make_port(const std::string& name, const spec::ArraySpec& array,
                                            const spec::Topology& topology, const PortRequest& request) {
  if (name == "engine") return make_engine(array, topology, request);
  const auto waking = name == "systemc" ? systemc::Waking::by_phase : systemc::Waking::by_clock;
  return std::make_unique<levels::SystemcPort>(sc_core::sc_gen_unique_name("array"), array, topology, waking,
                                       request.wave, stop_requested);
}

std::vector<std::string> method_names() {
  std::vector<std::string> names = level_names();
  names.insert(names.end(), rivals::names().begin(), rivals::names().end());
  return names;
}

void check_level(const std::string& name, const std::string& flag, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw input::input_error("", 0, flag, name, fmt::format("{}", fmt::join(names, ", ")),
                             input::nearest_name(name, names));
}

Level make_level(const std::string& name, const Prepared& p, bool check, const PortRequest& request) {
  Level level;
  level.name = name;
  const spec::ArraySpec& array = p.inputs.array;
  if (name == "reference") {
    level.motion = std::make_unique<levels::ReferenceMotion>(p.inputs.scene, *p.mesh, array);
    return level;
  }
  const auto& rivals = rivals::names();
  if (std::find(rivals.begin(), rivals.end(), name) != rivals.end()) {
    level.motion = std::make_unique<levels::RivalMotion>(name, p.inputs.scene, *p.mesh);
    return level;
  }
  level.port = make_port(name, array, p.mesh->topology(), request);
  auto motion = std::make_unique<levels::ArrayMotion>(p.inputs.scene, *p.mesh, array, *level.port, check);
  level.array = motion.get();
  level.motion = std::move(motion);
  return level;
}

} // namespace hopmesh::cli
