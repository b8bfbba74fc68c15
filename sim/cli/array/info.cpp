// hopmesh info: what a scene makes of an array, without building it.
#include "sim/run/array_info.h"

#include "sim/cli/options.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

int info(const input::InputWords& words, bool toml) {
  const levels::Prepared p = prepare(words);
  if (toml) {
    fmt::print("# scene\n{}\n# array\n{}", scene::scene_text(p.inputs.scene),
               input::array_text(p.inputs.array));
    return done;
  }
  fmt::print("{}\n{}", p.inputs.scene.name,
             run::text_of(run::array_info(p.inputs.scene, *p.mesh, p.inputs.array)));
  fmt::print("Array file\n{}", input::array_text(p.inputs.array));
  return done;
}

} // namespace

void add_info(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<input::InputWords>();
  auto toml = std::make_shared<bool>(false);
  CLI::App* verb =
      program.add_subcommand("info", "what the scene makes of the array: neurons, links, memory, cycles");
  add_common(*verb, *o);
  verb->add_flag("--toml", *toml, "scene and array with every default filled in, as files");
  verb->footer("Example:\n  hopmesh info flag-400 --array descent --set array.lanes=3");
  verb->callback([o, toml, &exit_code] { exit_code = info(*o, *toml); });
}

} // namespace hopmesh::cli
