#include "tests/bench/bench_networks.h"

#include "rtl_model/spec/presets.h"
#include "sim/levels/built_mesh.h"
#include "sim/scene/scene_file.h"

#include "place.h"

#include <stdexcept>

namespace hopmesh::bench {
namespace {

spec::Topology flag_mesh(const std::vector<std::string>& overrides) {
  return levels::BuiltMesh(
             scene::read_inputs(HOPMESH_SOURCE_DIR "/sim/scenes/flag-400.toml", "", overrides).scene)
      .topology();
}

/// A column more than there are cells: the left one is pinned.
spec::Topology small_mesh() {
  return flag_mesh({"mesh.grid.rows=5", "mesh.grid.columns=5"});
}

spec::ArraySpec with_reciprocal(spec::ArraySpec array) {
  array.normaliser = spec::Normaliser::reciprocal;
  return array;
}

} // namespace

BenchNetwork bench_network(const std::string& name) {
  if (name == "flag") return {spec::default_array(), flag_mesh({})};
  if (name == "small") return {spec::default_array(), small_mesh()};
  if (name == "planar")
    return {spec::default_array(),
            flag_mesh({"mesh.grid.rows=4", "mesh.grid.columns=5", "mesh.planar=true"})};
  if (name == "narrow") return {with_reciprocal(spec::descent_array()), small_mesh()};
  if (name == "byte") return {with_reciprocal(spec::byte_array()), small_mesh()};
  throw std::invalid_argument("no network is named " + name);
}

} // namespace hopmesh::bench
