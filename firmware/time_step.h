/* A time step's parameters, the state that it advances, and what it took: every array is the caller's. */
#ifndef HOPMESH_FIRMWARE_TIME_STEP_H
#define HOPMESH_FIRMWARE_TIME_STEP_H

#include "firmware/relax.h"

typedef struct hm_step_parameters {
  const struct hm_formulation* formulation; /* firmware/formulation.h lists them */
  double time_step, friction;               /* s; factor on v each step */
  double mass, drag;                        /* kg of a node; 1/s, -drag * v is an acceleration */
  double gamma, beta;                       /* probe: eq. 7; beta_i = beta dt^4 mean alpha */
  double acceleration_memory;               /* probe: 1: the paper's literal eq. 7; 0: a lives one step */
  int energy_of_all_springs;                /* probe: Delta E_i: 0 the node's own springs, 1 all springs */
  int force_on_acceleration;                /* probe: 0: v += dt * force; 1: a += force */
  double force[3];                          /* acceleration of every free node: gravity + wind */
  const double* node_force; /* incremental: [nodes * 3] of each node's own beside it; null: none */
  double threshold;
  uint32_t max_sweeps, expansions;
  uint32_t refinements;  /* incremental: corrections of an expansion's answer by its residual */
  uint32_t reload_every; /* incremental: weights stay in the array for so many steps; 0 and 1: for none */
} hm_step_parameters;

/* What corrections of earlier steps leave: nothing of it needs to be set. */
typedef struct hm_kept {
  double reach;    /* of the network whose weights the array has, h times its scale; 0: none to go on with */
  double inertia;  /* in them, kg/s^2 */
  uint64_t step;   /* that loaded them */
  double softness; /* how far a residual of 1 moves an output, at a reach of 1; 0: not known yet */
} hm_kept;

/* State between steps, and room to work in. */
typedef struct hm_state {
  double *position, *velocity; /* [nodes * 3] */
  double* acceleration;        /* [nodes * 3]; incremental: change of acceleration; static: of place */
  double *previous_position, *previous_velocity; /* [nodes * 3] a step before, else null: see looks_back */
  double* predicted;                             /* [nodes * 3] C of the step just done */
  double* energy_change;                         /* probe: [cells] Delta E of the step just done (eq. 6) */
  double* direction;  /* probe: [cells * 3] in which each cell's node was pushed in the step just done */
  double* start;      /* [cells * components] V0 of the last expansion, before relaxing */
  hm_network network; /* of the step just done; output holds V at rest */
  double scale;       /* incremental: what an output of 1 stands for in that network, m/s^2; static: m */
  double* correction; /* incremental, with refinements or reload_every: [4 * cells * components], else null */
  hm_kept kept;
  uint64_t step; /* steps done */
} hm_state;

/* What came of a step's corrections. */
typedef struct hm_refinement {
  uint32_t corrections; /* that were kept */
  uint32_t refused;     /* those that would have raised the network's energy */
  double residual;      /* largest of neurons that may still move, over the largest |I|; 0: nobody asked */
} hm_refinement;

typedef struct hm_step_result {
  hm_relaxation relaxation; /* all of the step together; converged: the last one */
  hm_refinement refinement;
  uint32_t lost_node; /* with HM_ERROR_LOST: the first */
} hm_step_result;

#endif
