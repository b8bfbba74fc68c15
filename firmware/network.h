/* Mesh and predicted motion -> weights and bias of the modified Hopfield network (docs/method/theory.md,
   sections 1 and 2). No heap: every array belongs to the caller. */
#ifndef HOPMESH_FIRMWARE_NETWORK_H
#define HOPMESH_FIRMWARE_NETWORK_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HM_PINNED UINT32_MAX

/* What a spring holds at length l: weight (l - L)^2, or, whatever its length, a constant pull: weight times l
   smoothed to sqrt(l^2 + floor^2), which has a direction at any length. */
enum { HM_LINEAR, HM_TENSION };

typedef struct hm_spring {
  uint32_t node[2];
  double weight;      /* alpha: J/m^2; under HM_TENSION the pull, J/m */
  double rest_length; /* L; none under HM_TENSION */
  uint32_t link[2];   /* index into link_to of the link node[0] -> node[1] and back; set by hm_mesh_connect */
} hm_spring;

/* The mesh as the firmware sees it. Cells are the free nodes in ascending node order. A component p of a
   neuron acts along coordinate axis[p]: {0, 1, 2}, or {0, 2} in a planar mesh, where y never moves. A network
   that is no mesh has cells of one component and links, but no nodes and no springs: the driver asks for
   nothing else. */
typedef struct hm_mesh {
  uint32_t nodes, springs, cells, components;
  uint32_t axis[3];
  int law;                      /* HM_LINEAR or HM_TENSION, of every spring */
  double floor;                 /* HM_TENSION: m, above 0 */
  hm_spring* spring;            /* [springs] */
  const double* beta_weight;    /* [nodes] mean alpha of the node's springs: beta_i = beta * dt^4 * this */
  const uint32_t* cell_of_node; /* [nodes] or HM_PINNED */
  const uint32_t* node_of_cell; /* [cells] */
  const uint32_t* first_link;   /* [cells + 1] */
  const uint32_t* link_to;      /* [first_link[cells]] neighbour cells, ascending in each row */
} hm_mesh;

/* A network. Rows of `weight` follow rtl_model/spec/topology.h: for each cell, for each component p, the
   cell's own components, then each neighbour's in link order. bias and output: [cells * components]. */
typedef struct hm_network {
  double *weight, *bias, *output;
} hm_network;

/* Index of the first entry of the row of component p of a cell, and the row's length. */
uint32_t hm_row_offset(const hm_mesh* mesh, uint32_t cell, uint32_t p);
uint32_t hm_row_length(const hm_mesh* mesh, uint32_t cell);
uint32_t hm_weight_count(const hm_mesh* mesh);
uint32_t hm_neuron_count(const hm_mesh* mesh);

/* Finds each spring's two links. Returns HM_OK, or HM_ERROR_MESH if a spring between free nodes has none. */
int hm_mesh_connect(hm_mesh* mesh);

/* Writes W and I of docs/method/theory.md, section 2 about the expansion point network->output (V0), which
   stays as it is. predicted: C, [nodes * 3] in metres; h = dt^2 / 2; beta_scale = beta * dt^4. A spring of no
   length at the expansion point keeps its L = 0 part only (its direction is undefined). */
void hm_network_build(const hm_mesh* mesh, const double* predicted, double h, double beta_scale,
                      hm_network* network);

/* Weights and biases of the incremental potential (docs/method/theory.md, section 4), whose outputs move a
   node by reach * V metres and weigh inertia (kg/s^2) / 2 times the square of that. Compressed springs count
   convex: W is negative semi-definite. */
void hm_network_build_incremental(const hm_mesh* mesh, const double* predicted, double reach, double inertia,
                                  hm_network* network);

#ifdef __cplusplus
}
#endif

#endif
