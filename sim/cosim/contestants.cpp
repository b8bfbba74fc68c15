#include "sim/cosim/contestants.h"

#include "sim/levels/engine_port.h"
#include "sim/run/progress.h"
#include "sim/levels/systemc_port.h"
#include "sim/engine/choose.h"
#include "sim/input/input_error.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

using cosim::Contestant;
using cosim::SharedBus;

namespace {

// A pointer to the port's bus that keeps the port.
SharedBus bus_of(const std::shared_ptr<levels::ArrayPort>& port) {
  const hm_bus* bus = &port->bus();
  return {port, bus};
}

Contestant engine_contestant(const std::string& name, const engine::Options& options, std::uint64_t one_in) {
  const auto make = [options](const cosim::ArrayJob& job) -> SharedBus {
    try {
      return bus_of(
          std::make_shared<levels::EnginePort>(job.array, job.topology, options, levels::WaveRequest{}, stop_requested));
    } catch (const std::invalid_argument&) { // not on this processor, or not for this array
      return nullptr;
    }
  };
  return {name, make, false, one_in};
}

Contestant systemc_contestant(const std::string& name, systemc::Waking waking, std::uint64_t one_in) {
  const auto make = [waking](const cosim::ArrayJob& job) {
    return bus_of(std::make_shared<levels::SystemcPort>(sc_core::sc_gen_unique_name("array"), job.array, job.topology,
                                                waking, levels::WaveRequest{}, stop_requested));
  };
  return {name, make, true, one_in};
}

void add_engine(std::vector<Contestant>& all) {
  for (const std::string& kernel : engine::kernel_names())
    if (kernel != "auto") all.push_back(engine_contestant("engine (" + kernel + ")", {1, kernel, 1}, 1));
  all.push_back(engine_contestant("engine (2 threads)", {2, "auto", 1}, 8));
  all.push_back(engine_contestant("engine (sweeps following)", {1, "auto", 3}, 1));
}

} // namespace

const std::vector<std::string>& fixed_level_names() {
  static const std::vector<std::string> names{"engine", "systemc", "systemc-clock"};
  return names;
}

void check_fixed_level(const std::string& name, const std::string& flag) {
  const auto& names = fixed_level_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw input::input_error("", 0, flag, name, fmt::format("{}", fmt::join(names, ", ")),
                             input::nearest_name(name, names));
}

Contestant contestant_of(const std::string& level) {
  if (level == "engine") return engine_contestant(level, {}, 1);
  return systemc_contestant(level, level == "systemc" ? systemc::Waking::by_phase : systemc::Waking::by_clock,
                            1);
}

// The engine's first kernel takes any array: it leads where it takes part.
std::vector<Contestant> contestants_of(const std::vector<std::string>& levels) {
  const auto has = [&](const char* name) { return std::count(levels.begin(), levels.end(), name) > 0; };
  std::vector<Contestant> all;
  if (has("engine")) add_engine(all);
  if (has("systemc")) all.push_back(contestant_of("systemc"));
  if (has("systemc-clock")) {
    all.push_back(contestant_of("systemc-clock"));
    if (all.size() > 1) all.back().one_in = 8;
  }
  return all;
}

} // namespace hopmesh::cosim
