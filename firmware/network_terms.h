/* What one spring adds to a network's weights and bias (docs/method/theory.md, section 2): C only, for those
   who gather it. */
#ifndef HOPMESH_FIRMWARE_NETWORK_TERMS_H
#define HOPMESH_FIRMWARE_NETWORK_TERMS_H

#include "firmware/doubles.h"
#include "firmware/network.h"

/* What follows takes the number of components as `n`, so that a compiler can make one version of it for 3,
   the common case; axis[p] is p there. */
static inline uint32_t axis_of(const hm_mesh* mesh, uint32_t p, const uint32_t n) {
  return n == 3 ? p : mesh->axis[p];
}

/* u = C_i - C_j + h (V0_i - V0_j), all three coordinates; outputs of pinned nodes are zero. */
static inline void spring_vector(const hm_mesh* mesh, const hm_spring* spring, uint32_t i, uint32_t j,
                                 const double* predicted, double h, const double* output, double u[3],
                                 const uint32_t n) {
  const double *a = predicted + 3 * spring->node[0], *b = predicted + 3 * spring->node[1];
  for (uint32_t x = 0; x < 3; ++x) u[x] = a[x] - b[x];
  for (uint32_t p = 0; p < n; ++p) {
    const double vi = i == HM_PINNED ? 0.0 : output[i * n + p];
    const double vj = j == HM_PINNED ? 0.0 : output[j * n + p];
    u[axis_of(mesh, p, n)] += h * (vi - vj);
  }
}

/* S_e and f_e of a spring that pulls alike at any length; floor > 0 keeps both finite. */
static inline void tension_terms(const hm_mesh* mesh, const hm_spring* spring, const double u[3], double h,
                                 double s[3][3], double f[3], const uint32_t n) {
  const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2] + mesh->floor * mesh->floor);
  const double pull = spring->weight * h / length;
  double along[3];
  for (uint32_t p = 0; p < n; ++p) {
    const double up = u[axis_of(mesh, p, n)];
    along[p] = up / length;
    f[p] = pull * up;
  }
  for (uint32_t p = 0; p < n; ++p)
    for (uint32_t q = 0; q < n; ++q) s[p][q] = pull * h * ((p == q) - along[p] * along[q]);
}

/* S_e and f_e of one spring. A spring of no length has no direction: its L = 0 part alone. `convex`: a
   compressed spring's curvature across itself counts as none instead of negative. */
static inline void spring_terms(const hm_mesh* mesh, const hm_spring* spring, const double u[3], double h,
                                double s[3][3], double f[3], const uint32_t n, const int convex) {
  const double length = hm_length(u, 3);
  const double slack = length > 0 ? spring->rest_length / length : 0.0;
  const double curved = convex && slack > 1 ? 1.0 : slack;
  const double stiffness = 2 * spring->weight * h * h, pull = 2 * spring->weight * h * (1 - slack);
  double along[3];
  for (uint32_t p = 0; p < n; ++p) {
    const double up = u[axis_of(mesh, p, n)];
    along[p] = length > 0 ? up / length : 0.0;
    f[p] = pull * up;
  }
  for (uint32_t p = 0; p < n; ++p)
    for (uint32_t q = 0; q < n; ++q) {
      const double across = length > 0 ? (p == q) - along[p] * along[q] : 0.0;
      s[p][q] = stiffness * ((p == q) - curved * across);
    }
}

#endif
