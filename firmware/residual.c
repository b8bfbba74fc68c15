/* What is left to pull at the outputs of a step's network, spring by spring: no weight is asked. */
#include "firmware/residual.h"

#include "firmware/network_terms.h"

/* By how much the outputs of a spring's ends have come apart since V0; pinned nodes have none. */
static inline double parted(const double* V, const double* V0, uint32_t i, uint32_t j, uint32_t q,
                            const uint32_t n) {
  const double of_i = i == HM_PINNED ? 0.0 : V[i * n + q] - V0[i * n + q];
  const double of_j = j == HM_PINNED ? 0.0 : V[j * n + q] - V0[j * n + q];
  return of_i - of_j;
}

/* A spring pulls with f + S (dV_i - dV_j) at its first node, and as much the other way at its second. */
static inline void add_pull(const hm_mesh* mesh, const hm_spring* spring, const hm_increment* about,
                            const double* V, double* residual, const uint32_t n) {
  const uint32_t i = mesh->cell_of_node[spring->node[0]], j = mesh->cell_of_node[spring->node[1]];
  double u[3], s[3][3], f[3];
  spring_vector(mesh, spring, i, j, about->predicted, about->reach, about->start, u, n);
  if (mesh->law == HM_TENSION)
    tension_terms(mesh, spring, u, about->reach, s, f, n);
  else
    spring_terms(mesh, spring, u, about->reach, s, f, n, 1);
  for (uint32_t p = 0; p < n; ++p) {
    double pull = f[p];
    for (uint32_t q = 0; q < n; ++q) pull += s[p][q] * parted(V, about->start, i, j, q, n);
    if (i != HM_PINNED) residual[i * n + p] -= pull;
    if (j != HM_PINNED) residual[j * n + p] += pull;
  }
}

void hm_residual(const hm_mesh* mesh, const hm_increment* about, const double* V, double* residual) {
  const uint32_t neurons = hm_neuron_count(mesh);
  const double held = about->inertia * about->reach * about->reach;
  for (uint32_t k = 0; k < neurons; ++k) residual[k] = -held * V[k];
  for (uint32_t e = 0; e < mesh->springs; ++e)
    if (mesh->components == 3)
      add_pull(mesh, &mesh->spring[e], about, V, residual, 3);
    else
      add_pull(mesh, &mesh->spring[e], about, V, residual, mesh->components);
}
