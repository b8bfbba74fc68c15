#include "firmware/springs.h"

#include "firmware/doubles.h"

static double distance(const double* a, const double* b) {
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return hm_length(d, 3);
}

double hm_one_spring_energy(const hm_mesh* mesh, const hm_spring* spring, const double* a, const double* b) {
  const double length = distance(a, b);
  if (mesh->law == HM_TENSION) return spring->weight * sqrt(length * length + mesh->floor * mesh->floor);
  const double stretch = length - spring->rest_length;
  return spring->weight * stretch * stretch;
}

double hm_spring_energy(const hm_mesh* mesh, const double* position) {
  double sum = 0;
  for (const hm_spring* s = mesh->spring; s != mesh->spring + mesh->springs; ++s)
    sum += hm_one_spring_energy(mesh, s, position + 3 * s->node[0], position + 3 * s->node[1]);
  return sum;
}

double hm_longest_spring(const hm_mesh* mesh, const double* position) {
  double longest = 0;
  for (const hm_spring* s = mesh->spring; s != mesh->spring + mesh->springs; ++s) {
    const double length = distance(position + 3 * s->node[0], position + 3 * s->node[1]);
    if (length > longest) longest = length;
  }
  return longest;
}

int hm_springs_are_quadratic(const hm_mesh* mesh) {
  for (uint32_t e = 0; e < mesh->springs; ++e)
    if (mesh->spring[e].rest_length != 0) return 0;
  return mesh->law == HM_LINEAR;
}
