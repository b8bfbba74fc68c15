/* Weights and bias from mesh and motion: docs/method/theory.md, section 2. */
#include "firmware/network.h"

#include "firmware/bus.h"
#include "firmware/doubles.h"
#include "firmware/network_terms.h"

uint32_t hm_row_length(const hm_mesh* mesh, uint32_t cell) {
  return mesh->components * (1 + mesh->first_link[cell + 1] - mesh->first_link[cell]);
}

uint32_t hm_row_offset(const hm_mesh* mesh, uint32_t cell, uint32_t p) {
  const uint32_t blocks_before = cell + mesh->first_link[cell];
  return mesh->components * mesh->components * blocks_before + p * hm_row_length(mesh, cell);
}

uint32_t hm_weight_count(const hm_mesh* mesh) {
  return mesh->components * mesh->components * (mesh->cells + mesh->first_link[mesh->cells]);
}

uint32_t hm_neuron_count(const hm_mesh* mesh) {
  return mesh->cells * mesh->components;
}

static uint32_t find_link(const hm_mesh* mesh, uint32_t from, uint32_t to) {
  for (uint32_t k = mesh->first_link[from]; k < mesh->first_link[from + 1]; ++k)
    if (mesh->link_to[k] == to) return k;
  return HM_PINNED;
}

int hm_mesh_connect(hm_mesh* mesh) {
  for (uint32_t e = 0; e < mesh->springs; ++e) {
    hm_spring* spring = &mesh->spring[e];
    const uint32_t i = mesh->cell_of_node[spring->node[0]], j = mesh->cell_of_node[spring->node[1]];
    spring->link[0] = spring->link[1] = HM_PINNED;
    if (i == HM_PINNED || j == HM_PINNED) continue;
    spring->link[0] = find_link(mesh, i, j);
    spring->link[1] = find_link(mesh, j, i);
    if (spring->link[0] == HM_PINNED || spring->link[1] == HM_PINNED) return HM_ERROR_MESH;
  }
  return HM_OK;
}

static inline void add_block(double* at, uint32_t row, double block[3][3], const uint32_t n) {
  for (uint32_t p = 0; p < n; ++p, at += row)
    for (uint32_t q = 0; q < n; ++q) at[q] += block[p][q];
}

static inline void take_block(double* at, uint32_t row, double block[3][3], const uint32_t n) {
  for (uint32_t p = 0; p < n; ++p, at += row)
    for (uint32_t q = 0; q < n; ++q) at[q] -= block[p][q];
}

/* An end of a spring: H_ii += S, H_ij = -S; so W gets the opposite. */
static inline void add_spring_end(const hm_mesh* mesh, hm_network* network, uint32_t cell, uint32_t link,
                                  double s[3][3], const uint32_t n) {
  const uint32_t first = mesh->first_link[cell], row = n * (1 + mesh->first_link[cell + 1] - first);
  double* own = network->weight + n * n * (cell + first);
  take_block(own, row, s, n);
  if (link != HM_PINNED) add_block(own + n * (1 + link - first), row, s, n);
}

/* A spring's part of its ends' rows; g_i += f, g_j -= f, and the bias gets -g. */
static inline void add_spring(const hm_mesh* mesh, const hm_spring* spring, const double* predicted, double h,
                              hm_network* network, const uint32_t n, const int convex) {
  const uint32_t i = mesh->cell_of_node[spring->node[0]], j = mesh->cell_of_node[spring->node[1]];
  double u[3], s[3][3], f[3];
  spring_vector(mesh, spring, i, j, predicted, h, network->output, u, n);
  if (mesh->law == HM_TENSION)
    tension_terms(mesh, spring, u, h, s, f, n);
  else
    spring_terms(mesh, spring, u, h, s, f, n, convex);
  if (i != HM_PINNED) {
    add_spring_end(mesh, network, i, spring->link[0], s, n);
    for (uint32_t p = 0; p < n; ++p) network->bias[i * n + p] -= f[p];
  }
  if (j != HM_PINNED) {
    add_spring_end(mesh, network, j, spring->link[1], s, n);
    for (uint32_t p = 0; p < n; ++p) network->bias[j * n + p] += f[p];
  }
}

/* The unit-length term of one node: W_ii -= B_i, -g_i -= b_i. Where V0 has no direction (only after a second
   expansion) the term pulls to straight down: beta |V - m|^2. */
static inline void add_unit_term(const hm_mesh* mesh, hm_network* network, uint32_t cell, double beta,
                                 const uint32_t n) {
  const double* v = network->output + cell * n;
  double block[3][3], along[3], square = 0;
  for (uint32_t p = 0; p < n; ++p) square += v[p] * v[p];
  const double length = sqrt(square);
  const int short_of_direction = length < 1e-9;
  for (uint32_t p = 0; p < n; ++p) along[p] = short_of_direction ? 0.0 : v[p] / length;
  for (uint32_t p = 0; p < n; ++p) {
    const double down = p + 1 == n ? -1.0 : 0.0;
    for (uint32_t q = 0; q < n; ++q) {
      const double turn = short_of_direction ? 0.0 : ((p == q) - along[p] * along[q]) / length;
      block[p][q] = 2 * beta * ((p == q) - turn);
    }
    network->bias[cell * n + p] -= 2 * beta * (short_of_direction ? v[p] - down : (length - 1) * along[p]);
  }
  const uint32_t first = mesh->first_link[cell], row = n * (1 + mesh->first_link[cell + 1] - first);
  take_block(network->weight + n * n * (cell + first), row, block, n);
}

/* I = H V0 - g = -W V0 - g; the bias holds -g so far. The cell's rows side by side: each sum keeps its order,
   and none waits for another. */
static inline void add_expansion_point(const hm_mesh* mesh, hm_network* network, uint32_t cell,
                                       const uint32_t n) {
  const uint32_t first = mesh->first_link[cell], end = mesh->first_link[cell + 1],
                 row = n * (1 + end - first);
  const double *at = network->weight + n * n * (cell + first), *v = network->output + cell * n;
  double sum[3] = {0, 0, 0};
  for (uint32_t k = first;; ++k) {
    for (uint32_t q = 0; q < n; ++q)
      for (uint32_t p = 0; p < n; ++p) sum[p] += at[p * row + q] * v[q];
    if (k == end) break;
    at += n;
    v = network->output + mesh->link_to[k] * n;
  }
  for (uint32_t p = 0; p < n; ++p) network->bias[cell * n + p] -= sum[p];
}

/* The inertia term of one node: W_ii -= mu, -g_i -= mu V0. */
static inline void add_inertia(const hm_mesh* mesh, hm_network* network, uint32_t cell, double inertia,
                               const uint32_t n) {
  const uint32_t first = mesh->first_link[cell], row = n * (1 + mesh->first_link[cell + 1] - first);
  double* own = network->weight + n * n * (cell + first);
  for (uint32_t p = 0; p < n; ++p) {
    own[p * row + p] -= inertia;
    network->bias[cell * n + p] -= inertia * network->output[cell * n + p];
  }
}

/* What the outputs mean: the probe's directions, or scaled accelerations of an implicit step. */
enum meaning { DIRECTIONS, ACCELERATIONS };

/* Springs and one term a node: of weight `of_node`, times beta_weight where outputs are directions. */
static inline void add_all(const hm_mesh* mesh, const double* predicted, double h, double of_node,
                           hm_network* network, const uint32_t n, const enum meaning meaning) {
  for (uint32_t e = 0; e < mesh->springs; ++e)
    add_spring(mesh, &mesh->spring[e], predicted, h, network, n, meaning == ACCELERATIONS);
  for (uint32_t c = 0; c < mesh->cells; ++c) {
    if (meaning == DIRECTIONS)
      add_unit_term(mesh, network, c, of_node * mesh->beta_weight[mesh->node_of_cell[c]], n);
    else
      add_inertia(mesh, network, c, of_node, n);
    add_expansion_point(mesh, network, c, n);
  }
}

static void clear(const hm_mesh* mesh, hm_network* network) {
  const uint32_t weights = hm_weight_count(mesh), biases = hm_neuron_count(mesh);
  for (uint32_t k = 0; k < weights; ++k) network->weight[k] = 0;
  for (uint32_t k = 0; k < biases; ++k) network->bias[k] = 0;
}

void hm_network_build(const hm_mesh* mesh, const double* predicted, double h, double beta_scale,
                      hm_network* network) {
  clear(mesh, network);
  if (mesh->components == 3)
    add_all(mesh, predicted, h, beta_scale, network, 3, DIRECTIONS);
  else
    add_all(mesh, predicted, h, beta_scale, network, mesh->components, DIRECTIONS);
}

void hm_network_build_incremental(const hm_mesh* mesh, const double* predicted, double reach, double inertia,
                                  hm_network* network) {
  clear(mesh, network);
  if (mesh->components == 3)
    add_all(mesh, predicted, reach, inertia * reach * reach, network, 3, ACCELERATIONS);
  else
    add_all(mesh, predicted, reach, inertia * reach * reach, network, mesh->components, ACCELERATIONS);
}
