#include "sim/levels/mover.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::levels {

namespace {

double distance(const double* a, const double* b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

} // namespace

void measure(const scene::Mesh& mesh, const double* x, const double* v, StepRow& row) {
  double energy = 0, kinetic = 0, strain = 0, stretch = 0;
  for (const scene::Spring& s : mesh.springs) {
    const double length = distance(x + 3 * s.node[0], x + 3 * s.node[1]);
    if (mesh.law == scene::SpringLaw::tension)
      energy += s.weight * std::sqrt(length * length + mesh.floor * mesh.floor);
    else
      energy += s.weight * (length - s.rest_length) * (length - s.rest_length);
    const bool at_rest = s.rest_length > 0; // else it is measured against how it was built
    const double born =
        at_rest ? s.rest_length : distance(mesh.position[s.node[0]].data(), mesh.position[s.node[1]].data());
    const double ratio = length / born;
    if (at_rest) strain = std::max(strain, std::fabs(ratio - 1));
    stretch = std::max(stretch, ratio);
  }
  for (std::size_t k = 0; k < 3 * mesh.nodes(); ++k) kinetic += 0.5 * mesh.mass * v[k] * v[k];
  row.energy = energy, row.kinetic = kinetic, row.max_strain = strain, row.max_stretch = stretch;
}

} // namespace hopmesh::levels
