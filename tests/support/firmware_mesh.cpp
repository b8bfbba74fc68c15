// Cells are the free nodes in ascending order; links join free nodes that share a spring.
#include "tests/support/firmware_mesh.h"

#include <set>

namespace hopmesh::tests {

FirmwareMesh::FirmwareMesh(const std::vector<PlainSpring>& springs, const std::vector<bool>& pinned,
                           std::uint32_t components)
    : beta_weight_(pinned.size(), 0.0), cell_of_node_(pinned.size(), HM_PINNED), first_link_{0} {
  for (std::uint32_t node = 0; node < pinned.size(); ++node) {
    if (pinned[node]) continue;
    cell_of_node_[node] = static_cast<std::uint32_t>(node_of_cell_.size());
    node_of_cell_.push_back(node);
  }
  std::vector<std::set<std::uint32_t>> neighbours(node_of_cell_.size());
  std::vector<int> springs_of(pinned.size(), 0);
  for (const PlainSpring& s : springs) {
    springs_.push_back({{s.a, s.b}, s.weight, s.rest_length, {0, 0}});
    for (std::uint32_t node : {s.a, s.b}) beta_weight_[node] += s.weight, springs_of[node] += 1;
    if (pinned[s.a] || pinned[s.b]) continue;
    neighbours[cell_of_node_[s.a]].insert(cell_of_node_[s.b]);
    neighbours[cell_of_node_[s.b]].insert(cell_of_node_[s.a]);
  }
  for (std::size_t node = 0; node < pinned.size(); ++node)
    if (springs_of[node] > 0) beta_weight_[node] /= springs_of[node];
  for (const auto& row : neighbours) {
    link_to_.insert(link_to_.end(), row.begin(), row.end());
    first_link_.push_back(static_cast<std::uint32_t>(link_to_.size()));
  }
  mesh.nodes = static_cast<std::uint32_t>(pinned.size());
  mesh.springs = static_cast<std::uint32_t>(springs_.size());
  mesh.cells = static_cast<std::uint32_t>(node_of_cell_.size());
  mesh.components = components;
  const std::uint32_t spatial[] = {0, 1, 2}, planar[] = {0, 2, 0};
  for (int p = 0; p < 3; ++p) mesh.axis[p] = components == 3 ? spatial[p] : planar[p];
  mesh.spring = springs_.data();
  mesh.beta_weight = beta_weight_.data();
  mesh.cell_of_node = cell_of_node_.data();
  mesh.node_of_cell = node_of_cell_.data();
  mesh.first_link = first_link_.data();
  mesh.link_to = link_to_.data();
  weight.resize(std::size_t{components} * components * (mesh.cells + link_to_.size()));
  bias.resize(neurons());
  output.resize(neurons());
  network = {weight.data(), bias.data(), output.data()};
}

} // namespace hopmesh::tests
