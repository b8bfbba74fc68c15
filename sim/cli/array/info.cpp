// hopmesh info: what a scene makes of an array, without building it.
#include "sim/run/array_info.h"
#include "sim/run/machine_info.h"

#include "sim/cli/options.h"

#include <fmt/format.h>

namespace hopmesh::cli {

namespace {

struct InfoOrder {
  input::InputWords words;
  bool toml = false;
  std::string picture;     ///< file for it; empty: none
  std::int64_t sweeps = 0; ///< of the step whose time is told; 0: as many as the scene allows
};

int info(const InfoOrder& o) {
  const levels::Prepared p = prepare(o.words);
  if (!o.picture.empty())
    run::write_machine_picture(p.inputs.array, p.mesh->topology(), p.inputs.scene.name, o.picture);
  if (o.toml) {
    fmt::print("# scene\n{}\n# array\n{}", scene::scene_text(p.inputs.scene),
               input::array_text(p.inputs.array));
    return done;
  }
  run::StepLoad step = run::longest_step(p.inputs.scene);
  if (o.sweeps > 0) step.sweeps = static_cast<std::uint64_t>(o.sweeps);
  fmt::print("{}\n{}", p.inputs.scene.name,
             run::text_of(run::array_info(p.inputs.scene, *p.mesh, p.inputs.array, step)));
  fmt::print("Array file\n{}", input::array_text(p.inputs.array));
  return done;
}

} // namespace

void add_info(CLI::App& program, int& exit_code) {
  auto o = std::make_shared<InfoOrder>();
  CLI::App* verb =
      program.add_subcommand("info", "what the scene makes of the array: neurons, links, cycles, silicon");
  add_common(*verb, o->words);
  verb->add_option("--sweeps", o->sweeps,
                   "sweeps of the step whose time is told (as many as the scene allows)")
      ->check(whole_number(1));
  verb->add_option("--picture", o->picture, "FILE.svg: the machine in a picture, with its figures");
  verb->add_flag("--toml", o->toml, "scene and array with every default filled in, as files");
  verb->footer("Example:\n  hopmesh info flag-400 --array descent --set array.lanes=3");
  verb->callback([o, &exit_code] { exit_code = info(*o); });
}

} // namespace hopmesh::cli
