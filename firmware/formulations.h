/* The formulations of a time step (docs/method/theory.md, section 4), and what they share: for integrator.c
   and them alone. */
#ifndef HOPMESH_FIRMWARE_FORMULATIONS_H
#define HOPMESH_FIRMWARE_FORMULATIONS_H

#include "firmware/integrator.h"

/* Each does one step as hm_step says; state->step counts it afterwards. */
int hm_probe_step(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver, hm_state* state,
                  hm_step_result* result);
int hm_incremental_step(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver,
                        hm_state* state, hm_step_result* result);

/* Outputs as they are now become the start of the next relaxation, for whoever asks afterwards. */
void hm_keep_start(const hm_mesh* mesh, hm_state* state);
/* Relaxes the network as it stands and adds to the result what that took. */
int hm_relax(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver, hm_state* state,
             hm_step_result* result);

double hm_length(const double* v, uint32_t n);
double hm_one_spring_energy(const hm_mesh* mesh, const hm_spring* spring, const double* a, const double* b);
int hm_is_finite(double x);

#endif
