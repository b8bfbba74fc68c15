#include "sim/levels/left_over.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/reference/rest.h"

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

double fall_left(const reference::BlockNetwork& network, const Vector& start, const Vector& V,
                 const Vector& rest) {
  const auto above = [&](const Vector& at) { return reference::energy_above(network, rest, at); };
  const double whole = std::max(above(start), least_part * above(Vector::Zero(V.size())));
  return whole > 0 ? std::max(0.0, above(V)) / whole : 0;
}

namespace {

// A product in double costs about as much as a sweep of the engine. Few show little of a long way.
constexpr std::uint32_t least_products = 8, most_products = 48, sweeps_a_product = 24;

/// A network of zeros whose weights lie as the firmware's do.
reference::Network empty_network(const BuiltMesh& mesh) {
  const hm_mesh& m = mesh.firmware();
  const std::uint32_t n = m.components;
  const auto neurons = static_cast<Eigen::Index>(hm_neuron_count(&m));
  reference::Network network{reference::Matrix(neurons, neurons), Vector::Zero(neurons)};
  network.W.resizeNonZeros(hm_weight_count(&m));
  std::fill_n(network.W.valuePtr(), hm_weight_count(&m), 0.0);
  auto *start = network.W.outerIndexPtr(), *column = network.W.innerIndexPtr();
  const auto add = [&](std::uint32_t source) {
    for (std::uint32_t q = 0; q < n; ++q) *column++ = static_cast<int>(source * n + q);
  };
  for (std::uint32_t c = 0; c < m.cells; ++c)
    for (std::uint32_t p = 0; p < n; ++p) {
      add(c);
      for (std::uint32_t k = m.first_link[c]; k < m.first_link[c + 1]; ++k) add(m.link_to[k]);
      *++start = static_cast<int>(column - network.W.innerIndexPtr());
    }
  return network;
}

} // namespace

LeftOver::LeftOver(const BuiltMesh& mesh)
    : blocks_(empty_network(mesh), static_cast<Eigen::Index>(mesh.components())) {}

// An energy falls by the mean of s at both ends times the way.
double LeftOver::look(const hm_network& network, const std::vector<double>& start, std::uint32_t sweeps) {
  const auto neurons = static_cast<Eigen::Index>(start.size());
  blocks_.refill(network.weight, network.bias);
  const Eigen::Map<const Vector> I(network.bias, neurons);
  const Vector V = Eigen::Map<const Vector>(network.output, neurons), V0 = vector_of(start);
  const auto input_at = [&](const Vector& at) {
    reference::Quads s(blocks_.nodes());
    blocks_.inputs(blocks_.bias(), blocks_.spread(at), s);
    return blocks_.gathered(s);
  };
  const std::uint32_t products = std::clamp(sweeps / sweeps_a_product, least_products, most_products);
  const Vector below = reference::way_down(blocks_, V, products);
  const Vector s = input_at(V), s0 = input_at(V0), s_below = input_at(below);
  const double seen = std::max(0.0, (s + s_below).dot(below - V) / 2);
  const double done = (s + s0).dot(V - V0) / 2, from_none = (s + I).dot(V) / 2;
  const double whole = std::max(done + seen, least_part * (from_none + seen));
  return whole > 0 ? seen / whole : 0;
}

} // namespace hopmesh::levels
