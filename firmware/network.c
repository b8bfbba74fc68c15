/* Weights and bias from mesh and motion: docs/theory.md, section 2. */
#include "firmware/network.h"

#include "firmware/bus.h"

double sqrt(double); /* IEEE: correctly rounded everywhere; the only function asked of the platform */

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

/* Adds `sign` * block to the block of a cell's rows that stands `place` blocks to the right of its own. */
static void add_block(const hm_mesh* mesh, hm_network* network, uint32_t cell, uint32_t place, double sign,
                      double block[3][3]) {
  const uint32_t n = mesh->components, row = hm_row_length(mesh, cell);
  double* at = network->weight + hm_row_offset(mesh, cell, 0) + place * n;
  for (uint32_t p = 0; p < n; ++p)
    for (uint32_t q = 0; q < n; ++q) at[p * row + q] += sign * block[p][q];
}

/* u = C_i - C_j + h (V0_i - V0_j), all three coordinates; outputs of pinned nodes are zero. */
static void spring_vector(const hm_mesh* mesh, const hm_spring* spring, const double* predicted, double h,
                          const double* output, double u[3]) {
  const double *a = predicted + 3 * spring->node[0], *b = predicted + 3 * spring->node[1];
  const uint32_t i = mesh->cell_of_node[spring->node[0]], j = mesh->cell_of_node[spring->node[1]];
  for (uint32_t x = 0; x < 3; ++x) u[x] = a[x] - b[x];
  for (uint32_t p = 0; p < mesh->components; ++p) {
    const double vi = i == HM_PINNED ? 0.0 : output[i * mesh->components + p];
    const double vj = j == HM_PINNED ? 0.0 : output[j * mesh->components + p];
    u[mesh->axis[p]] += h * (vi - vj);
  }
}

/* S_e and f_e of one spring. A spring of no length has no direction: its L = 0 part alone. */
static void spring_terms(const hm_mesh* mesh, const hm_spring* spring, const double u[3], double h,
                         double s[3][3], double f[3]) {
  const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  const double slack = length > 0 ? spring->rest_length / length : 0.0;
  const double stiffness = 2 * spring->weight * h * h, pull = 2 * spring->weight * h * (1 - slack);
  for (uint32_t p = 0; p < mesh->components; ++p) {
    const double up = u[mesh->axis[p]];
    f[p] = pull * up;
    for (uint32_t q = 0; q < mesh->components; ++q) {
      const double across = length > 0 ? (p == q) - (up / length) * (u[mesh->axis[q]] / length) : 0.0;
      s[p][q] = stiffness * ((p == q) - slack * across);
    }
  }
}

/* One end of a spring: H_ii += S, H_ij = -S, g_i += side * f; so W and -g get the opposite. */
static void add_spring_end(const hm_mesh* mesh, hm_network* network, uint32_t cell, uint32_t link,
                           double side, double s[3][3], const double f[3]) {
  if (cell == HM_PINNED) return;
  add_block(mesh, network, cell, 0, -1.0, s);
  if (link != HM_PINNED) add_block(mesh, network, cell, 1 + link - mesh->first_link[cell], 1.0, s);
  for (uint32_t p = 0; p < mesh->components; ++p) network->bias[cell * mesh->components + p] -= side * f[p];
}

/* The unit-length term of one node: W_ii -= B_i, -g_i -= b_i. Where V0 has no direction (only after a second
   expansion) the term pulls to straight down: beta |V - m|^2. */
static void add_unit_term(const hm_mesh* mesh, hm_network* network, uint32_t cell, double beta) {
  const uint32_t n = mesh->components;
  const double* v = network->output + cell * n;
  double block[3][3], square = 0;
  for (uint32_t p = 0; p < n; ++p) square += v[p] * v[p];
  const double length = sqrt(square);
  const int short_of_direction = length < 1e-9;
  for (uint32_t p = 0; p < n; ++p) {
    const double down = p + 1 == n ? -1.0 : 0.0;
    const double mp = short_of_direction ? down : v[p] / length;
    for (uint32_t q = 0; q < n; ++q) {
      const double turn = short_of_direction ? 0.0 : ((p == q) - mp * (v[q] / length)) / length;
      block[p][q] = 2 * beta * ((p == q) - turn);
    }
    network->bias[cell * n + p] -= 2 * beta * (short_of_direction ? v[p] - down : (length - 1) * mp);
  }
  add_block(mesh, network, cell, 0, -1.0, block);
}

/* I = H V0 - g = -W V0 - g; the bias holds -g so far. */
static void add_expansion_point(const hm_mesh* mesh, hm_network* network, uint32_t cell) {
  const uint32_t n = mesh->components;
  for (uint32_t p = 0; p < n; ++p) {
    const double* row = network->weight + hm_row_offset(mesh, cell, p);
    double sum = 0;
    for (uint32_t q = 0; q < n; ++q) sum += row[q] * network->output[cell * n + q];
    for (uint32_t k = mesh->first_link[cell]; k < mesh->first_link[cell + 1]; ++k)
      for (uint32_t q = 0; q < n; ++q)
        sum += row[n * (1 + k - mesh->first_link[cell]) + q] * network->output[mesh->link_to[k] * n + q];
    network->bias[cell * n + p] -= sum;
  }
}

void hm_network_build(const hm_mesh* mesh, const double* predicted, double h, double beta_scale,
                      hm_network* network) {
  const uint32_t weights = hm_weight_count(mesh), biases = mesh->cells * mesh->components;
  for (uint32_t k = 0; k < weights; ++k) network->weight[k] = 0;
  for (uint32_t k = 0; k < biases; ++k) network->bias[k] = 0;
  for (uint32_t e = 0; e < mesh->springs; ++e) {
    const hm_spring* spring = &mesh->spring[e];
    double u[3], s[3][3], f[3];
    spring_vector(mesh, spring, predicted, h, network->output, u);
    spring_terms(mesh, spring, u, h, s, f);
    add_spring_end(mesh, network, mesh->cell_of_node[spring->node[0]], spring->link[0], 1.0, s, f);
    add_spring_end(mesh, network, mesh->cell_of_node[spring->node[1]], spring->link[1], -1.0, s, f);
  }
  for (uint32_t c = 0; c < mesh->cells; ++c)
    add_unit_term(mesh, network, c, beta_scale * mesh->beta_weight[mesh->node_of_cell[c]]);
  for (uint32_t c = 0; c < mesh->cells; ++c) add_expansion_point(mesh, network, c);
}
