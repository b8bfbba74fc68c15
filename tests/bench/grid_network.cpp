#include "tests/bench/grid_network.h"

#include "firmware/registers.h"
#include "sim/engine/device.h"
#include "sim/levels/array_motion.h"

namespace hopmesh::bench {

namespace {

struct Port : levels::ArrayPort {
  Port(const spec::ArraySpec& array, const spec::Topology& topology, const std::atomic<bool>& stop)
      : device(array, topology, {}, stop) {}
  const hm_bus& bus() override { return device.bus(); }
  engine::Device device;
};

std::vector<std::int32_t> window(const hm_bus& bus, std::uint32_t base, std::size_t count) {
  std::vector<std::int32_t> codes(count);
  bus.read_burst(bus.context, base, reinterpret_cast<std::uint32_t*>(codes.data()),
                 static_cast<std::uint32_t>(count));
  return codes;
}

const std::uint32_t* words(const std::vector<std::int32_t>& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

} // namespace

void GridNetwork::load(engine::Engine& e) const {
  e.write_weights(0, words(weights), weights.size());
  e.write_biases(0, words(biases), biases.size());
  e.write_outputs(0, words(start), start.size());
}

GridNetwork scene_network(const std::string& scene, int step, const std::string& array,
                          const std::vector<std::string>& overrides) {
  static const std::atomic<bool> never{false};
  const scene::Inputs inputs = scene::read_inputs(scene, array, overrides);
  const levels::BuiltMesh mesh(inputs.scene);
  Port port(inputs.array, mesh.topology(), never);
  levels::ArrayMotion motion(inputs.scene, mesh, inputs.array, port, false);
  for (int k = 0; k <= step; ++k) motion.advance();
  const hm_bus& bus = port.bus();
  return {inputs.array, mesh.topology(), window(bus, HM_WINDOW_WEIGHT, mesh.topology().weight_words()),
          window(bus, HM_WINDOW_BIAS, mesh.topology().neurons()), motion.start_raw()};
}

GridNetwork grid_network(std::size_t rows, std::size_t columns, int step, const std::string& array,
                         std::vector<std::string> overrides) {
  overrides.push_back("mesh.grid.rows=" + std::to_string(rows));
  overrides.push_back("mesh.grid.columns=" + std::to_string(columns));
  return scene_network("flag-400", step, array, overrides);
}

} // namespace hopmesh::bench
