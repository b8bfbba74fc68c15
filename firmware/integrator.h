/* A time step: predict, build the network, relax it wherever the solver says, advance
   (docs/method/theory.md, section 4). */
#ifndef HOPMESH_FIRMWARE_INTEGRATOR_H
#define HOPMESH_FIRMWARE_INTEGRATOR_H

#include "firmware/formulation.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Advances by one step. HM_OK, or the solver's error, or HM_ERROR_LOST; on an error positions, velocities and
   accelerations are untouched. */
int hm_step(const hm_mesh* mesh, const hm_step_parameters* parameters, const hm_solver* solver,
            hm_state* state, hm_step_result* result);

#ifdef __cplusplus
}
#endif

#endif
