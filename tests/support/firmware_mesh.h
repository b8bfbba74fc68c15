// Owns what an hm_mesh and an hm_network point into, built from plain lists of nodes and springs.
#pragma once

#include <cstdint>

extern "C" {
#include "firmware/network.h"
}

#include <vector>

namespace hopmesh::tests {

struct PlainSpring {
  std::uint32_t a, b;
  double weight, rest_length;
};

class FirmwareMesh {
 public:
  FirmwareMesh(const std::vector<PlainSpring>& springs, const std::vector<bool>& pinned,
               std::uint32_t components);
  FirmwareMesh(const FirmwareMesh&) = delete;
  FirmwareMesh& operator=(const FirmwareMesh&) = delete;

  hm_mesh mesh{};
  std::vector<double> weight, bias, output; ///< room for one network
  hm_network network{};

  std::uint32_t neurons() const { return mesh.cells * mesh.components; }

 private:
  std::vector<hm_spring> springs_;
  std::vector<double> beta_weight_;
  std::vector<std::uint32_t> cell_of_node_, node_of_cell_, first_link_, link_to_;
};

} // namespace hopmesh::tests
