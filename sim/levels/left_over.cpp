#include "sim/levels/left_over.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::levels {

using reference::Vector;

namespace {

constexpr double least_part = 1e-3; // of the fall from outputs of 0

double row_input(const hm_mesh& m, const hm_network& network, std::uint32_t cell, std::uint32_t p) {
  const double* weight = network.weight + hm_row_offset(&m, cell, p);
  double s = network.bias[cell * m.components + p];
  const auto add = [&](std::uint32_t source) {
    for (std::uint32_t q = 0; q < m.components; ++q)
      s += *weight++ * network.output[source * m.components + q];
  };
  add(cell);
  for (std::uint32_t k = m.first_link[cell]; k < m.first_link[cell + 1]; ++k) add(m.link_to[k]);
  return s;
}

bool is_held(double s, double V) {
  return (V >= 1 && s > 0) || (V <= -1 && s < 0);
}

} // namespace

double input_left(const hm_mesh& mesh, const hm_network& network) {
  double left = 0, whole = 0;
  for (std::uint32_t c = 0; c < mesh.cells; ++c)
    for (std::uint32_t p = 0; p < mesh.components; ++p) {
      const std::uint32_t neuron = c * mesh.components + p;
      const double s = row_input(mesh, network, c, p);
      if (!is_held(s, network.output[neuron])) left = std::max(left, std::fabs(s));
      whole = std::max(whole, std::fabs(network.bias[neuron]));
    }
  return whole > 0 ? left / whole : 0;
}

double input_left(const reference::Network& network, const Vector& V) {
  const double whole = network.I.cwiseAbs().maxCoeff();
  return whole > 0 ? reference::movable_input(network, V).cwiseAbs().maxCoeff() / whole : 0;
}

double fall_left(const reference::Network& network, const Vector& start, const Vector& V,
                 const Vector& rest) {
  const Vector none = Vector::Zero(V.size());
  const double whole =
      std::max(reference::fall(network, start, rest), least_part * reference::fall(network, none, rest));
  return whole > 0 ? std::max(0.0, reference::fall(network, V, rest)) / whole : 0;
}

} // namespace hopmesh::levels
