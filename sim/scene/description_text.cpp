// Descriptions written back as TOML, every default spelled out, so that a run can be repeated from its
// record.
#include "sim/scene/scene_file.h"

#include <fmt/format.h>

namespace hopmesh::scene {

namespace {

/// The shortest digits that read back as the same double, always with a point or an exponent.
std::string number(double x) {
  const std::string digits = fmt::format("{}", x);
  return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

std::string string(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string vector(const Vector3& v) {
  return fmt::format("[{}, {}, {}]", number(v[0]), number(v[1]), number(v[2]));
}

std::string pin(const Pin& pin) {
  const auto* name = std::get_if<std::string>(&pin);
  return name ? string(*name) : std::to_string(std::get<std::int64_t>(pin));
}

std::string pins(const std::vector<Pin>& all) {
  std::string out;
  for (const Pin& one : all) out += (out.empty() ? "" : ", ") + pin(one);
  return '[' + out + ']';
}

std::string pin_ball_text(const MeshSpec& mesh) {
  if (!mesh.pin_ball) return "";
  return fmt::format("pin_ball = {{ centre = {}, radius = {} }}\n", vector(mesh.pin_ball->centre),
                     number(mesh.pin_ball->radius));
}

std::string law_text(const MeshSpec& mesh) {
  const std::string law = mesh.law == SpringLaw::tension ? "tension" : "linear";
  return "law = " + string(law) + (mesh.floor ? ", floor = " + number(*mesh.floor) : "");
}

std::string shape_text(const MeshSpec& mesh) {
  if (mesh.grid)
    return fmt::format("grid = {{ rows = {}, columns = {}, pitch = {} }}\n"
                       "springs = {{ structural = {}, shear = {}, bend = {}, {} }}\n",
                       mesh.grid->rows, mesh.grid->columns, number(mesh.grid->pitch), number(mesh.structural),
                       number(mesh.shear), number(mesh.bend), law_text(mesh));
  return fmt::format("file = {}\nscale = {}\nup = {}\npin_band = {}\nsprings = {{ structural = {}, {} }}\n",
                     string(mesh.file.value_or("")), number(mesh.scale), string(mesh.up),
                     number(mesh.pin_band), number(mesh.structural), law_text(mesh));
}

std::string mesh_text(const MeshSpec& mesh) {
  return fmt::format("\n[mesh]\n{}pinned = {}\n{}mass = {}\nrest = {}\nplanar = {}\n"
                     "start = {{ shuffle = {}, seed = {}, velocity = {} }}\n",
                     shape_text(mesh), pins(mesh.pinned), pin_ball_text(mesh), number(mesh.mass),
                     mesh.rest ? number(*mesh.rest) : string("natural"), mesh.planar,
                     number(mesh.start.shuffle), mesh.start.seed, vector(mesh.start.velocity));
}

std::string motion_text(const MotionSpec& motion) {
  const char* formulation = motion.formulation == Formulation::probe ? "probe" : "incremental";
  return fmt::format("\n[motion]\nformulation = \"{}\"\ntime_step = {}\nsteps = {}\nfriction = {}\n",
                     formulation, number(motion.time_step), motion.steps, number(motion.friction));
}

std::string probe_text(const ProbeSpec& probe) {
  return fmt::format(
      "\n[probe]\ngamma = {}\nbeta = {}\nacceleration_memory = {}\nenergy_springs = {}\nforce_on = {}\n",
      number(probe.gamma), number(probe.beta), number(probe.acceleration_memory),
      string(probe.energy_springs), string(probe.force_on));
}

std::string incremental_text(const IncrementalSpec& incremental) {
  return fmt::format("\n[incremental]\nrule = {}\n", string(incremental.rule));
}

std::string relax_text(const RelaxSpec& relax) {
  return fmt::format("\n[relax]\nthreshold = {}\nmax_sweeps = {}\nexpansions = {}\n", number(relax.threshold),
                     relax.max_sweeps, relax.expansions);
}

std::string image_text(const ImageSpec& image) {
  return fmt::format("image = {{ file = {}, pitch = {}, strength = {}, smoothing = {} }}\n",
                     string(image.file), number(image.pitch), number(image.strength),
                     number(image.smoothing));
}

std::string force_text(const ForceSpec& force) {
  const std::string wind = force.wind ? "wind = " + vector(*force.wind) + '\n' : "";
  return fmt::format("\n[force]\ngravity = {}\n{}drag = {}\n{}", vector(force.gravity), wind,
                     number(force.drag), force.image ? image_text(*force.image) : "");
}

} // namespace

std::string scene_text(const Scene& scene) {
  return "name = " + string(scene.name) + '\n' + mesh_text(scene.mesh) + motion_text(scene.motion) +
         probe_text(scene.probe) + incremental_text(scene.incremental) + relax_text(scene.relax) +
         force_text(scene.force);
}

std::string array_text(const spec::ArraySpec& a) {
  const spec::Formats& f = a.formats;
  const std::string accumulator = a.exact_accumulator ? "exact" : f.accumulator.text();
  return fmt::format(
      "name = {}\n\n[array]\nschedule = \"{}\"\nlanes = {}\noutput = \"{}\"\nnormaliser = \"{}\"\n"
      "reciprocal_bits = {}\nbus_bits = {}\nclock_mhz = {}\n\n[formats]\nweight = \"{}\"\nbias = "
      "\"{}\"\naccumulator = \"{}\"\n"
      "drive = \"{}\"\nstate = \"{}\"\nlink = \"{}\"\n",
      string(a.name), name_of(a.schedule), a.lanes, name_of(a.output), name_of(a.normaliser),
      a.reciprocal_bits, a.bus_bits, number(a.clock_mhz), f.weight.text(), f.bias.text(), accumulator,
      f.drive.text(), f.state.text(), f.link.text());
}

} // namespace hopmesh::scene
