#include "sim/cli/options.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/cli/progress.h"
#include "sim/cli/systemc_port.h"

#include <charconv>
#include <fmt/format.h>

namespace hopmesh::cli {

CLI::Validator whole_number(std::int64_t least) {
  constexpr std::int64_t most = 1'000'000'000; // as many steps as a scene may have
  const auto judge = [=](const std::string& text) {
    std::int64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    if (failure == std::errc() && stop == end && number >= least && number <= most) return std::string();
    return fmt::format("found {}, expected an integer from {} to {}", text, least, most);
  };
  return CLI::Validator(judge, "");
}

void add_common(CLI::App& verb, CommonOptions& options) {
  verb.add_option("SCENE", options.scene, "a scene file, or the name of a shipped scene")->required();
  verb.add_option("--array", options.array, "an array file, or the name of a preset");
  verb.add_option("--set", options.overrides, "key.path=value: overrides a key of the scene or the array")
      ->allow_extra_args(false);
}

Prepared prepare(const CommonOptions& options) {
  Prepared p{scene::read_inputs(options.scene, options.array, options.overrides), nullptr};
  p.mesh = std::make_unique<study::BuiltMesh>(p.inputs.scene);
  if (const auto fault = spec::validate(p.inputs.array, p.mesh->topology().most_taps()))
    throw scene::input_error(options.array, 0, fault->key, fault->found, fault->expected);
  return p;
}

const std::vector<std::string>& level_names() {
  static const std::vector<std::string> names{"reference", "systemc", "systemc-clock"};
  return names;
}

Level make_level(const std::string& name, const Prepared& p, bool check, const WaveRequest& wave,
                 const std::string& flag) {
  Level level;
  level.name = name;
  const spec::ArraySpec& array = p.inputs.array;
  if (name == "reference") {
    level.motion = std::make_unique<study::ReferenceMotion>(p.inputs.scene, *p.mesh, array.schedule);
    return level;
  }
  if (name != "systemc" && name != "systemc-clock")
    throw scene::input_error("", 0, flag, name, fmt::format("{}", fmt::join(level_names(), ", ")),
                             scene::nearest_name(name, level_names()));
  const auto waking = name == "systemc" ? systemc::Waking::by_phase : systemc::Waking::by_clock;
  level.port = std::make_unique<SystemcPort>(sc_core::sc_gen_unique_name("array"), array, p.mesh->topology(),
                                             waking, wave, stop_requested);
  auto motion = std::make_unique<study::ArrayMotion>(p.inputs.scene, *p.mesh, array, *level.port, check);
  level.array = motion.get();
  level.motion = std::move(motion);
  return level;
}

} // namespace hopmesh::cli
