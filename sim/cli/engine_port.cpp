#include "sim/cli/engine_port.h"

namespace hopmesh::cli {

std::vector<study::SignalRange> EnginePort::inner_ranges() const {
  const engine::Engine& e = device_.engine();
  const engine::Extremes& x = e.extremes();
  const auto sum = spec::accumulator_format(e.array(), e.topology().most_taps());
  return {{"accumulator", sum, x.least_sum, x.largest_sum},
          {"drive", e.array().formats.drive, x.least_drive, x.largest_drive}};
}

} // namespace hopmesh::cli
