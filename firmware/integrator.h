/* One time step: predict, build the network, relax it wherever the solver says, advance
   (docs/method/theory.md, section 4). */
#ifndef HOPMESH_FIRMWARE_INTEGRATOR_H
#define HOPMESH_FIRMWARE_INTEGRATOR_H

#include "firmware/driver.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Whoever relaxes a network: the driver with an array behind it, or anything that answers the same way. */
typedef struct hm_solver {
  void* context;
  int (*relax)(void* context, const hm_mesh* mesh, hm_network* network, double threshold, uint32_t max_sweeps,
               hm_relaxation* result);
} hm_solver;

/* What the outputs mean: directions (the paper), accelerations of an implicit step, or (static) displacements
   towards the least potential energy. */
enum { HM_PROBE, HM_BACKWARD_EULER, HM_BDF2, HM_STATIC };

typedef struct hm_motion {
  int rule;
  double time_step, friction; /* s; factor on v each step */
  double mass, drag;          /* incremental: kg of a node; 1/s, -drag * v is an acceleration */
  double gamma, beta;         /* probe: eq. 7; beta_i = beta dt^4 mean alpha */
  double acceleration_memory; /* 1: the paper's literal eq. 7; 0: a lives one step */
  int energy_of_all_springs;  /* Delta E_i: 0 the node's own springs, 1 all springs */
  int force_on_acceleration;  /* 0: v += dt * force; 1: a += force */
  double force[3];            /* acceleration of every free node: gravity + wind */
  const double* node_force;   /* incremental: [nodes * 3] of each node's own beside it; null: none */
  double threshold;
  uint32_t max_sweeps, expansions;
} hm_motion;

/* State between steps and room to work in; every array is the caller's. */
typedef struct hm_state {
  double *position, *velocity,
      *acceleration; /* [nodes * 3]; incremental: change of acceleration, static: of place */
  double *previous_position, *previous_velocity; /* [nodes * 3] a step before; BDF2 only, else may be null */
  double* predicted;                             /* [nodes * 3] C of the step just done */
  double* energy_change;                         /* [cells] Delta E of the step just done (eq. 6) */
  double* direction;  /* [cells * 3] in which each cell's node was pushed in the step just done */
  double* start;      /* [cells * components] V0 of the last expansion, before relaxing */
  hm_network network; /* of the step just done; output holds V at rest */
  double scale;       /* incremental: what an output of 1 stands for in that network, m/s^2; static: m */
  uint64_t step;      /* steps done */
} hm_state;

typedef struct hm_step_result {
  uint32_t sweeps, converged; /* summed over relaxations; converged in the last one */
  uint32_t relaxations;       /* expansions, and those repeated at another scale */
  uint32_t lost_node;         /* with HM_ERROR_LOST: the first */
  uint64_t cycles;
} hm_step_result;

/* Advances by one step. HM_OK, or the solver's error, or HM_ERROR_LOST; on an error positions, velocities and
   accelerations are untouched. */
int hm_step(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver, hm_state* state,
            hm_step_result* result);

/* What all springs hold (hm_mesh.law), positions [nodes * 3]. */
double hm_spring_energy(const hm_mesh* mesh, const double* position);

#ifdef __cplusplus
}
#endif

#endif
