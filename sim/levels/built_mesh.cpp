#include "sim/levels/built_mesh.h"

#include "firmware/bus.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace hopmesh::levels {

BuiltMesh::BuiltMesh(const scene::Scene& scene) : mesh_(scene::build_mesh(scene)) {
  number_cells();
  find_links();
  std::vector<double> sum(mesh_.nodes(), 0.0), count(mesh_.nodes(), 0.0);
  springs_.reserve(mesh_.springs.size());
  for (const scene::Spring& s : mesh_.springs) {
    springs_.push_back(hm_spring{{s.node[0], s.node[1]}, s.weight, s.rest_length, {0, 0}});
    for (std::uint32_t node : s.node) sum[node] += s.weight, count[node] += 1;
  }
  beta_weight_.resize(mesh_.nodes(), 0.0);
  for (std::size_t i = 0; i < mesh_.nodes(); ++i)
    if (count[i] > 0) beta_weight_[i] = sum[i] / count[i];

  firmware_.nodes = static_cast<std::uint32_t>(mesh_.nodes());
  firmware_.springs = static_cast<std::uint32_t>(springs_.size());
  firmware_.cells = static_cast<std::uint32_t>(node_of_cell_.size());
  firmware_.components = static_cast<std::uint32_t>(topology_.neurons_per_cell);
  firmware_.axis[1] = mesh_.planar ? 2 : 1;
  firmware_.axis[2] = 2;
  firmware_.law = mesh_.law == scene::SpringLaw::tension ? HM_TENSION : HM_LINEAR;
  firmware_.floor = mesh_.floor;
  firmware_.spring = springs_.data();
  firmware_.beta_weight = beta_weight_.data();
  firmware_.cell_of_node = cell_of_node_.data();
  firmware_.node_of_cell = node_of_cell_.data();
  firmware_.first_link = topology_.first_link.data();
  firmware_.link_to = topology_.link_to.data();
  if (hm_mesh_connect(&firmware_) != HM_OK) throw std::logic_error("a spring has no link");
}

void BuiltMesh::number_cells() {
  cell_of_node_.assign(mesh_.nodes(), HM_PINNED);
  for (std::uint32_t i = 0; i < mesh_.nodes(); ++i) {
    if (mesh_.pinned[i]) continue;
    cell_of_node_[i] = static_cast<std::uint32_t>(node_of_cell_.size());
    node_of_cell_.push_back(i);
  }
}

// Rows are counted, filled and sorted in one array. A pair that two springs join is one link.
void BuiltMesh::find_links() {
  topology_.neurons_per_cell = mesh_.planar ? 2 : 3;
  const auto for_each_link = [this](auto body) {
    for (const scene::Spring& s : mesh_.springs) {
      const std::uint32_t a = cell_of_node_[s.node[0]], b = cell_of_node_[s.node[1]];
      if (a != HM_PINNED && b != HM_PINNED) body(a, b), body(b, a);
    }
  };
  std::vector<std::uint32_t> end(node_of_cell_.size() + 1, 0); // of each row, once it is filled
  for_each_link([&](std::uint32_t from, std::uint32_t) { end[from + 1] += 1; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<std::uint32_t>& link_to = topology_.link_to;
  link_to.resize(end.back());
  for_each_link([&](std::uint32_t from, std::uint32_t to) { link_to[end[from]++] = to; });

  topology_.first_link.reserve(end.size());
  topology_.first_link.push_back(0);
  auto row = link_to.begin(), kept = link_to.begin();
  for (std::size_t c = 0; c < node_of_cell_.size(); ++c) {
    const auto row_end = link_to.begin() + end[c];
    std::sort(row, row_end);
    kept = std::unique_copy(row, row_end, kept);
    row = row_end;
    topology_.first_link.push_back(static_cast<std::uint32_t>(kept - link_to.begin()));
  }
  link_to.erase(kept, link_to.end());
}

} // namespace hopmesh::levels
