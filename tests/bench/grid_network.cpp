#include "tests/bench/grid_network.h"

#include "sim/levels/bus_array.h"
#include "sim/levels/level.h"

namespace hopmesh::bench {

namespace {

const std::uint32_t* words(const std::vector<std::int32_t>& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

} // namespace

void GridNetwork::load(engine::Engine& e) const {
  e.write_weights(0, words(weights), weights.size());
  e.write_biases(0, words(biases), biases.size());
  e.write_outputs(0, words(start), start.size());
  e.write_momentum(0, words(momentum), momentum.size());
}

GridNetwork scene_network(const std::string& scene, int step, const std::string& array,
                          const std::vector<std::string>& overrides) {
  const levels::Prepared p = levels::prepare(scene, array, overrides);
  const levels::ReadyLevel level = levels::make_ready(levels::default_level(), p);
  for (int k = 0; k <= step; ++k) level.mover->advance();
  const levels::BusArray loaded(level.port->bus(), p.mesh->topology());
  const spec::ArraySpec& a = p.inputs.array;
  std::vector<std::int32_t> momentum;
  if (spec::has_momentum(a)) momentum = loaded.momentum(static_cast<std::size_t>(a.momentum_entries));
  return {a, p.mesh->topology(), loaded.weights(), loaded.biases(), level.array->start_raw(), momentum};
}

GridNetwork grid_network(std::size_t rows, std::size_t columns, int step, const std::string& array,
                         std::vector<std::string> overrides) {
  overrides.push_back("mesh.grid.rows=" + std::to_string(rows));
  overrides.push_back("mesh.grid.columns=" + std::to_string(columns));
  return scene_network("flag-400", step, array, overrides);
}

} // namespace hopmesh::bench
