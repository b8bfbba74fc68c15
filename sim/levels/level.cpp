#include "sim/levels/level.h"

#include "rtl_model/systemc/open_neuron.h"
#include "sim/engine/choose.h"
#include "sim/engine/generic/open_neuron.h"
#include "sim/input/input_error.h"
#include "sim/input/standard_streams.h"
#include "sim/levels/interrupt.h"
#include "sim/levels/ports/engine_port.h"
#include "sim/levels/ports/rtl_level.h"
#include "sim/levels/ports/systemc_port.h"
#include "sim/levels/reference_mover.h"
#include "sim/levels/rival_mover.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::levels {

namespace {

Level reference_row() {
  Level row{"reference", Kind::reference, "the algorithm in double, sweep by sweep"};
  row.make_mover = [](const Prepared& p) {
    return std::make_unique<ReferenceMover>(p.inputs.scene, *p.mesh, p.inputs.array);
  };
  return row;
}

std::unique_ptr<ArrayPort> make_engine_port(const spec::ArraySpec& array, const spec::Topology& topology,
                                            const PortRequest& request) {
  engine::Options options = request.engine;
  if (!request.all_threads) options.threads = engine::useful_threads(topology, options.threads);
  auto port = std::make_unique<EnginePort>(array, topology, options, request.wave, stop_requested);
  const std::string why = port->engine().why_no_kernel();
  if (!why.empty() && request.remarks)
    input::say(
        fmt::format("hopmesh: engine: no fast kernel for {}; the generic path computes this array\n", why));
  return port;
}

template <typename Neuron> OpenNeuron lay_open(const spec::ArraySpec& array, std::size_t taps) {
  const auto neuron = std::make_shared<Neuron>(array, taps);
  return [neuron](const spec::FiringInputs& inputs) { return neuron->fire(inputs); };
}

// Every kernel, two threads, and sweeps that follow each other. The first kernel takes any array.
std::vector<Variant> engine_variants() {
  std::vector<Variant> all;
  for (const std::string& kernel : engine::kernel_names())
    if (kernel != "auto") all.push_back({kernel, {1, kernel, 1}, 1});
  all.push_back({"2 threads", {2, "auto", 1}, 8});
  all.push_back({"sweeps following", {1, "auto", 3}, 1});
  return all;
}

Level engine_row() {
  Level row{"engine", Kind::array, "the array, by a native program"};
  row.make_port = make_engine_port;
  row.variants = engine_variants();
  row.open_neuron = lay_open<engine::OpenNeuron>;
  row.can_wave = true;
  row.checked = false; // the reference would take most of the time
  return row;
}

Level systemc_row(const std::string& name, const std::string& words, systemc::Waking waking) {
  Level row{name, Kind::array, words};
  row.make_port = [waking](const spec::ArraySpec& array, const spec::Topology& topology,
                           const PortRequest& request) {
    return std::make_unique<SystemcPort>(sc_core::sc_gen_unique_name("array"), array, topology, waking,
                                         request.wave, stop_requested);
  };
  row.open_neuron = lay_open<systemc::OpenNeuron>;
  row.can_wave = true;
  row.made_ahead = true; // SystemC elaborates once a process
  return row;
}

Level systemc_by_phase() {
  return systemc_row("systemc", "the array, cycle by cycle in SystemC", systemc::Waking::by_phase);
}

Level systemc_by_clock() {
  Level row = systemc_row("systemc-clock", "the array in SystemC, every neuron woken by every clock (slow)",
                          systemc::Waking::by_clock);
  row.one_in = 8;
  return row;
}

Level rtl_row() {
  Level row{"rtl", Kind::array, "the array's Verilog, clock by clock under Verilator (folded arrays)"};
  row.make_port = [](const spec::ArraySpec& array, const spec::Topology& topology,
                     const PortRequest& request) {
    return make_rtl_port(array, topology, request.at_once, stop_requested);
  };
  row.named_only = true;
  row.make_ready = make_rtl_model;
  return row;
}

Level rival_row(const std::string& name) {
  Level row{name, Kind::rival, fmt::format("a rival in double; {}", rivals::about(name))};
  row.make_mover = [name](const Prepared& p) {
    return std::make_unique<RivalMover>(name, p.inputs.scene, *p.mesh);
  };
  return row;
}

std::vector<Level> make_table() {
  std::vector<Level> all{reference_row(), engine_row(), systemc_by_phase(), systemc_by_clock(), rtl_row()};
  for (const std::string& name : rivals::names()) all.push_back(rival_row(name));
  return all;
}

template <typename Wanted> std::vector<std::string> names_where(Wanted wanted) {
  std::vector<std::string> names;
  for (const Level& level : levels())
    if (wanted(level)) names.push_back(level.name);
  return names;
}

bool is_one_of(Kinds kinds, Kind kind) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

} // namespace

const std::vector<Level>& levels() {
  static const std::vector<Level> table = make_table();
  return table;
}

std::vector<std::string> level_names(Kinds kinds) {
  return names_where([&](const Level& level) { return is_one_of(kinds, level.kind); });
}

std::vector<std::string> compared_names() {
  return names_where([](const Level& level) {
    return is_one_of(sweeping, level.kind) && level.one_in == 1 && !level.named_only;
  });
}

std::vector<std::string> campaign_names() {
  return names_where([](const Level& level) { return level.kind == Kind::array && !level.named_only; });
}

const Level& level_named(const std::string& name, const std::string& where, Kinds kinds) {
  for (const Level& level : levels())
    if (level.name == name && is_one_of(kinds, level.kind)) return level;
  const auto names = level_names(kinds);
  throw input::input_error("", 0, where, name, fmt::format("{}", fmt::join(names, ", ")),
                           input::nearest_name(name, names));
}

const Level& default_level() {
  return level_named("engine", "");
}

namespace {

Way make_way(const Level& level, const Variant& variant) {
  PortRequest request;
  request.engine = variant.engine;
  request.all_threads = true;
  request.at_once = true;
  const auto make = [make = level.make_port, request](const spec::ArraySpec& array,
                                                      const spec::Topology& topology) {
    try {
      return make(array, topology, request);
    } catch (const std::invalid_argument&) { // not on this processor, or not for this array
      return std::unique_ptr<ArrayPort>();
    }
  };
  const std::string name =
      variant.name.empty() ? level.name : fmt::format("{} ({})", level.name, variant.name);
  return {name, make, level.made_ahead, level.one_in * variant.one_in};
}

} // namespace

std::vector<Way> ways_of(const std::vector<const Level*>& levels) {
  std::vector<Way> ways;
  for (const Level* level : levels)
    for (const Variant& variant : level->variants) ways.push_back(make_way(*level, variant));
  if (!ways.empty()) ways.front().one_in = 1;
  return ways;
}

ReadyLevel make_ready(const Level& level, const Prepared& p, bool check, const PortRequest& request) {
  ReadyLevel ready;
  ready.level = &level;
  if (!level.has_bus()) {
    ready.mover = level.make_mover(p);
    return ready;
  }
  ready.port = level.make_port(p.inputs.array, p.mesh->topology(), request);
  auto motion = std::make_unique<ArrayMover>(p.inputs.scene, *p.mesh, p.inputs.array, *ready.port, check);
  ready.array = motion.get();
  ready.mover = std::move(motion);
  return ready;
}

} // namespace hopmesh::levels
