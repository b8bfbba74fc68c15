/* A formulation of the time step (docs/method/theory.md, section 4): a struct of functions, and the table of
 * them.
 */
#ifndef HOPMESH_FIRMWARE_FORMULATION_H
#define HOPMESH_FIRMWARE_FORMULATION_H

#include "firmware/time_step.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A step in the making: what hm_step was given, and what `begin` of the formulation makes of it. */
typedef struct hm_step_work {
  const hm_mesh* mesh;
  const hm_step_parameters* parameters;
  const hm_solver* solver;
  hm_state* state;
  hm_relaxation* relaxation; /* sum of the step's */
  hm_refinement* refinement; /* of the step */
  double h;                  /* s^2: a node moves by h times its acceleration; static: 1 */
  double kept;               /* share of its velocity that a node keeps */
  double inertia;            /* incremental: kg/s^2, holds x to C; static: 0 */
  double most_scale;         /* incremental: the scale grows no further */
  int two_steps;             /* BDF2, with a step behind it */
} hm_step_work;

/* Where one coordinate of a free node gets to. */
typedef struct hm_coordinate {
  double position, velocity, acceleration;
} hm_coordinate;

typedef struct hm_formulation {
  const char* name; /* in scene files */
  int looks_back;   /* previous_position and previous_velocity are kept for it */
  /* C, the scale, and V0 in the outputs. */
  void (*begin)(hm_step_work* work);
  /* Weights and bias about the outputs as they are. */
  void (*build)(const hm_step_work* work);
  /* An expansion: builds and relaxes, hm_expand or more than one of it. */
  int (*relax)(const hm_step_work* work);
  /* Null where there are no corrections: I + W V of the network about state->start. */
  void (*residual)(const hm_step_work* work, const double* V, double* residual);
  /* Null, or what `next` asks for beside the outputs at rest. */
  void (*weigh)(const hm_step_work* work);
  /* next[p]: along component p of a cell's node. */
  void (*next)(const hm_step_work* work, uint32_t cell, hm_coordinate next[3]);
  /* Null, or what is left to do when all nodes have moved. */
  void (*finish)(const hm_step_work* work);
} hm_formulation;

extern const hm_formulation hm_probe, hm_backward_euler, hm_bdf2, hm_static;

static const hm_formulation* const hm_formulations[] = {&hm_probe, &hm_backward_euler, &hm_bdf2, &hm_static};

/* Expands the formulation's energy about the outputs as they are, and relaxes. */
static inline int hm_expand(const hm_step_work* work) {
  const hm_step_parameters* parameters = work->parameters;
  hm_state* state = work->state;
  parameters->formulation->build(work);
  return hm_relax(work->solver, work->mesh, &state->network, state->start, parameters->threshold,
                  parameters->max_sweeps, work->relaxation);
}

#ifdef __cplusplus
}
#endif

#endif
