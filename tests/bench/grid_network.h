// A network of a moving flag of any size, as raw codes: what the engine's benchmarks relax.
#pragma once

#include "sim/engine/engine.h"
#include "sim/levels/built_mesh.h"
#include "sim/scene/scene_file.h"

namespace hopmesh::bench {

struct GridNetwork {
  spec::ArraySpec array;
  spec::Topology topology;
  std::vector<std::int32_t> weights, biases, start; ///< on the bus, Topology order
  std::vector<std::int32_t> momentum;               ///< the table of m, of an array that has one

  std::size_t neurons() const { return topology.neurons(); }
  void load(engine::Engine& engine) const;
};

/// The network of step `step` of flag-400 with rows x columns nodes; `overrides` as of --set. The steps
/// before it are flown on the engine.
GridNetwork grid_network(std::size_t rows, std::size_t columns, int step, const std::string& array = "",
                         std::vector<std::string> overrides = {});
/// The network of a step of any scene.
GridNetwork scene_network(const std::string& scene, int step, const std::string& array,
                          const std::vector<std::string>& overrides);

} // namespace hopmesh::bench
