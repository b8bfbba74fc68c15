/* A time step in whole numbers alone (docs/method/theory.md, section 4): the probe and backward Euler, with
   meshes of springs in three components. Lengths count in powers of two that fit the mesh; outputs are Q29,
   forces and weights count in 2^-24 and less of `unit`, which no weight of a spring or node exceeds. */
#ifndef HOPMESH_FIRMWARE_FIXED_H
#define HOPMESH_FIRMWARE_FIXED_H

#include "firmware/driver.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  HM_FIXED_OUTPUT = 29, /* places of an output */
  HM_FIXED_WEIGHT = 24, /* of a weight, in units */
  HM_FIXED_FINER = 4,   /* places that a way in a step has beyond those of a position */
  HM_FIXED_PULL = 29,   /* of a pull, besides its exponent */
  HM_FIXED_ENERGY = 38  /* of an energy, in the largest alpha times m^2 */
};

/* Where an end of a spring adds to the weights: first entries of the cell's own block and of the link's, and
   how far apart the rows are. HM_PINNED: no cell, no link. */
typedef struct hm_fixed_end {
  uint32_t node, cell, own, link, row;
} hm_fixed_end;

typedef struct hm_fixed_spring {
  hm_fixed_end end[2];
  int32_t rest;      /* in places of a spring */
  int32_t stiffness; /* 2 alpha h^2 in units, Q30 */
  int32_t pull;      /* 2 alpha h in units a metre, HM_FIXED_PULL places, times 2^-pull_exponent */
  int32_t energy;    /* alpha over the largest's power of two, Q17 */
} hm_fixed_spring;

typedef struct hm_fixed_node {
  uint32_t node, own, row; /* of a cell, its own block's first entry and the way between its rows */
  int32_t weight;          /* probe: 2 beta; implicit: inertia h^2; in units, HM_FIXED_WEIGHT places */
} hm_fixed_node;

/* Mesh and motion. A number with an exponent is mantissa * 2^(exponent - 31), mantissa from 2^30 on. */
typedef struct hm_fixed_plan {
  uint32_t implicit; /* 1: backward Euler, 0: the probe */
  uint32_t nodes, springs, cells, weights;
  int32_t position_places, spring_places; /* of a metre */
  int32_t unit_exponent;                  /* a unit is 2^unit_exponent, at a scale of 1 */
  int32_t pull_exponent;
  int32_t h, h_exponent;
  int32_t gain, gain_exponent; /* probe: sqrt(gamma dt^4 alpha) of the largest alpha's power of two */
  int32_t kept;                /* Q30, of a velocity: probe and implicit alike */
  int32_t slowed;              /* Q30, implicit: of the way that is predicted */
  int32_t fall[3];             /* what the force adds to it, in places of a way */
  int32_t longest;             /* a component of a spring, in places of a position */
  uint32_t threshold, max_sweeps;
  int32_t most_scale, least_scale; /* exponents */
} hm_fixed_plan;

/* All of it that a step reads and writes; positions and ways [3 * nodes], others [3 * cells]. */
typedef struct hm_fixed_state {
  int32_t *position, *way; /* in a step, HM_FIXED_FINER places more than a position */
  int32_t* predicted;
  int32_t* change;    /* implicit: of acceleration, Q29 times 2^change_exponent */
  int32_t* output;    /* V at rest of the step before, then of this one */
  int32_t* start;     /* V0 */
  int32_t* direction; /* probe: Q29 */
  int32_t* next;      /* [6 * cells] room for positions and ways to come */
  int32_t* weight;    /* [weights] */
  int64_t* bias;      /* in 2^-bias_places units */
  int64_t* energy;    /* probe: [cells] */
  int32_t* kick;      /* probe: [cells] dt^2 times its acceleration, in places of a way */
  int32_t change_exponent, scale_exponent, bias_places;
  uint32_t step; /* 0 in the first one */
} hm_fixed_state;

typedef struct hm_fixed_mesh {
  const hm_fixed_spring* spring;
  const hm_fixed_node* node; /* [cells] */
} hm_fixed_mesh;

typedef struct hm_fixed_work {
  const hm_fixed_plan* plan;
  const hm_fixed_mesh* mesh;
  hm_fixed_state* state;
  hm_driver* driver;
  void* listener; /* handed to `heard` after each relaxation; it may be null */
  void (*heard)(void* listener, const hm_relaxation* one);
} hm_fixed_work;

/* A step. HM_OK, or an error of the driver, or HM_ERROR_LOST, with *lost_node: a node or a spring leaves the
   range of the numbers. On an error positions, ways and changes are untouched. */
int hm_fixed_step(const hm_fixed_work* work, hm_relaxation* sum, uint32_t* lost_node);

#ifdef __cplusplus
}
#endif

#endif
