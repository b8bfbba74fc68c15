#include "sim/cosim/contestants.h"

namespace hopmesh::cosim {

namespace {

// A pointer to the port's bus that keeps the port.
SharedBus bus_of(const std::shared_ptr<levels::ArrayPort>& port) {
  const hm_bus* bus = &port->bus();
  return {port, bus};
}

Contestant contestant_of(const levels::Level& level, const levels::Way& way) {
  levels::PortRequest request;
  request.engine = way.engine;
  request.quiet = request.all_threads = true;
  const auto make = [&level, request](const ArrayJob& job) -> SharedBus {
    try {
      return bus_of(level.make_port(job.array, job.topology, request));
    } catch (const std::invalid_argument&) { // not on this processor, or not for this array
      return nullptr;
    }
  };
  return {way.name, make, level.made_ahead, way.one_in};
}

} // namespace

Contestant contestant_of(const levels::Level& level) {
  return contestant_of(level, {level.name, {}, 1});
}

std::vector<Contestant> contestants_of(const std::vector<const levels::Level*>& levels) {
  std::vector<Contestant> all;
  for (const levels::Level* level : levels) {
    if (level->ways)
      for (const levels::Way& way : level->ways()) all.push_back(contestant_of(*level, way));
    else
      all.push_back(contestant_of(*level, {level->name, {}, all.empty() ? 1 : level->one_in}));
  }
  return all;
}

} // namespace hopmesh::cosim
