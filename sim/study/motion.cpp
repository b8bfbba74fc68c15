#include "sim/study/motion.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::study {

namespace {

double distance(const double* a, const double* b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return std::sqrt(x * x + y * y + z * z);
}

} // namespace

void measure(const scene::Mesh& mesh, const double* x, const double* v, StepRow& row) {
  row.energy = row.kinetic = row.max_strain = row.max_stretch = 0;
  for (const scene::Spring& s : mesh.springs) {
    const double length = distance(x + 3 * s.node[0], x + 3 * s.node[1]);
    const double born = distance(mesh.position[s.node[0]].data(), mesh.position[s.node[1]].data());
    row.energy += s.weight * (length - s.rest_length) * (length - s.rest_length);
    if (s.rest_length > 0) row.max_strain = std::max(row.max_strain, std::fabs(length / s.rest_length - 1));
    row.max_stretch = std::max(row.max_stretch, length / (s.rest_length > 0 ? s.rest_length : born));
  }
  for (std::size_t k = 0; k < 3 * mesh.nodes(); ++k) row.kinetic += 0.5 * mesh.mass * v[k] * v[k];
}

} // namespace hopmesh::study
