// A scene's mesh as the firmware and the array see it: cells for free nodes, links for springs between them.
#pragma once

#include "firmware/network.h"
#include "rtl_model/spec/topology.h"
#include "sim/scene/mesh.h"

#include <memory>

namespace hopmesh::levels {

/// Owns the arrays that hm_mesh points into; it neither moves nor copies.
class BuiltMesh {
 public:
  explicit BuiltMesh(const scene::Scene& scene);
  BuiltMesh(const BuiltMesh&) = delete;
  BuiltMesh& operator=(const BuiltMesh&) = delete;

  const scene::Mesh& mesh() const { return mesh_; }
  const hm_mesh& firmware() const { return firmware_; }
  const spec::Topology& topology() const { return topology_; }
  std::size_t components() const { return firmware_.components; }
  std::size_t nodes() const { return firmware_.nodes; }
  std::size_t cells() const { return firmware_.cells; }
  std::uint32_t node_of_cell(std::size_t cell) const { return node_of_cell_[cell]; }

  /// [nodes * components] from [cells * components]; pinned nodes get zeros.
  template <typename T> std::vector<T> by_node(const std::vector<T>& by_cell) const {
    const std::size_t n = components();
    std::vector<T> all(nodes() * n, T{});
    for (std::size_t c = 0; c < cells(); ++c)
      for (std::size_t p = 0; p < n; ++p) all[node_of_cell_[c] * n + p] = by_cell[c * n + p];
    return all;
  }

  /// [cells * components] from a vector over [nodes * components].
  template <typename Vector> std::vector<double> by_cell(const Vector& by_node) const {
    const std::size_t n = components();
    std::vector<double> of_cells(cells() * n);
    for (std::size_t k = 0; k < of_cells.size(); ++k) of_cells[k] = by_node[node_of_cell_[k / n] * n + k % n];
    return of_cells;
  }

  /// use(place in the weight memory, row, column) for every weight; rows and columns over [nodes *
  /// components].
  template <typename Use> void each_weight(Use use) const {
    const std::size_t n = components();
    for (std::size_t c = 0; c < cells(); ++c)
      for (std::size_t p = 0; p < n; ++p)
        for (std::size_t t = 0; t < topology_.taps(c); ++t) {
          const std::size_t from = t < n ? c : topology_.link_to[topology_.first_link[c] + t / n - 1];
          use(topology_.row_offset(c, p) + t, node_of_cell_[c] * n + p, node_of_cell_[from] * n + t % n);
        }
  }

 private:
  void number_cells();
  void find_links();

  scene::Mesh mesh_;
  spec::Topology topology_;
  std::vector<hm_spring> springs_;
  std::vector<double> beta_weight_;
  std::vector<std::uint32_t> cell_of_node_, node_of_cell_;
  hm_mesh firmware_{};
};

} // namespace hopmesh::levels
