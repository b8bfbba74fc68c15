#include "sim/levels/level.h"

#include "sim/engine/choose.h"
#include "sim/input/input_error.h"
#include "sim/levels/engine_port.h"
#include "sim/levels/reference_motion.h"
#include "sim/levels/rival_motion.h"
#include "sim/levels/stop.h"
#include "sim/levels/systemc_port.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::levels {

namespace {

std::unique_ptr<ArrayPort> engine_port(const spec::ArraySpec& array, const spec::Topology& topology,
                                       const PortRequest& request) {
  engine::Options useful = request.engine;
  if (!request.all_threads) useful.threads = engine::useful_threads(topology, useful.threads);
  auto port = std::make_unique<EnginePort>(array, topology, useful, request.wave, stop_requested);
  const std::string why = port->engine().why_no_kernel();
  if (!why.empty() && !request.quiet)
    fmt::print(stderr, "hopmesh: engine: no fast kernel for {}; the generic path computes this array\n", why);
  return port;
}

template <systemc::Waking waking>
std::unique_ptr<ArrayPort> systemc_port(const spec::ArraySpec& array, const spec::Topology& topology,
                                        const PortRequest& request) {
  return std::make_unique<SystemcPort>(sc_core::sc_gen_unique_name("array"), array, topology, waking,
                                       request.wave, stop_requested);
}

// Every kernel, two threads, and sweeps that follow each other. The first kernel takes any array.
std::vector<Way> engine_ways() {
  std::vector<Way> ways;
  for (const std::string& kernel : engine::kernel_names())
    if (kernel != "auto") ways.push_back({"engine (" + kernel + ")", {1, kernel, 1}, 1});
  ways.push_back({"engine (2 threads)", {2, "auto", 1}, 8});
  ways.push_back({"engine (sweeps following)", {1, "auto", 3}, 1});
  return ways;
}

std::vector<Level> make_table() {
  constexpr auto by_phase = systemc_port<systemc::Waking::by_phase>;
  constexpr auto by_clock = systemc_port<systemc::Waking::by_clock>;
  // name, kind, words, can_resume, can_wave, checked, made_ahead, one_in, make_port, ways
  std::vector<Level> all{
      {"reference", Kind::reference, "the algorithm in double", true, false, true, false, 1, nullptr,
       nullptr},
      {"engine", Kind::array, "the array as a native program", true, true, false, false, 1, engine_port,
       engine_ways},
      {"systemc", Kind::array, "the array in SystemC", true, true, true, true, 1, by_phase, nullptr},
      {"systemc-clock", Kind::array, "SystemC with every neuron woken at every clock", true, true, true, true,
       8, by_clock, nullptr},
  };
  for (const std::string& name : rivals::names())
    all.push_back(
        {name, Kind::rival, "another integrator, in double", true, false, true, false, 1, nullptr, nullptr});
  return all;
}

bool is_one(Kind kind, std::initializer_list<Kind> kinds) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

} // namespace

const std::vector<Level>& levels() {
  static const std::vector<Level> table = make_table();
  return table;
}

std::vector<std::string> level_names(std::initializer_list<Kind> kinds) {
  std::vector<std::string> names;
  for (const Level& level : levels())
    if (is_one(level.kind, kinds)) names.push_back(level.name);
  return names;
}

std::vector<std::string> method_names() {
  return level_names({Kind::reference, Kind::array, Kind::rival});
}

const Level& level_named(const std::string& name, const std::string& flag,
                         std::initializer_list<Kind> kinds) {
  for (const Level& level : levels())
    if (level.name == name && is_one(level.kind, kinds)) return level;
  const auto names = level_names(kinds);
  throw input::input_error("", 0, flag, name, fmt::format("{}", fmt::join(names, ", ")),
                           input::nearest_name(name, names));
}

const Level& default_level() {
  return level_named("engine", "");
}

const Level& reference_row() {
  return levels().front();
}

Ready make_ready(const Level& level, const Prepared& p, bool check, const PortRequest& request) {
  const spec::ArraySpec& array = p.inputs.array;
  Ready ready;
  ready.level = &level;
  if (level.kind == Kind::reference)
    ready.motion = std::make_unique<ReferenceMotion>(p.inputs.scene, *p.mesh, array);
  if (level.kind == Kind::rival)
    ready.motion = std::make_unique<RivalMotion>(level.name, p.inputs.scene, *p.mesh);
  if (!level.has_bus()) return ready;
  ready.port = level.make_port(array, p.mesh->topology(), request);
  auto motion = std::make_unique<ArrayMotion>(p.inputs.scene, *p.mesh, array, *ready.port, check);
  ready.array = motion.get();
  ready.motion = std::move(motion);
  return ready;
}

} // namespace hopmesh::levels
