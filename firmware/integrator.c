#include "firmware/integrator.h"

#include "firmware/bus.h"
#include "firmware/doubles.h"

/* The first cell whose node would have no finite place or velocity; HM_PINNED if there is none. */
static uint32_t first_lost(const hm_step_work* work) {
  const hm_mesh* mesh = work->mesh;
  hm_coordinate next[3];
  for (uint32_t c = 0; c < mesh->cells; ++c) {
    work->parameters->formulation->next(work, c, next);
    for (uint32_t p = 0; p < mesh->components; ++p)
      if (!hm_is_finite(next[p].position) || !hm_is_finite(next[p].velocity)) return c;
  }
  return HM_PINNED;
}

static void keep_previous(hm_state* state, uint32_t at) {
  state->previous_position[at] = state->position[at];
  state->previous_velocity[at] = state->velocity[at];
}

static void move(const hm_step_work* work) {
  const hm_formulation* formulation = work->parameters->formulation;
  const hm_mesh* mesh = work->mesh;
  hm_state* state = work->state;
  hm_coordinate next[3];
  for (uint32_t c = 0; c < mesh->cells; ++c) {
    formulation->next(work, c, next);
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t at = 3 * mesh->node_of_cell[c] + mesh->axis[p];
      if (formulation->looks_back) keep_previous(state, at);
      state->position[at] = next[p].position;
      state->velocity[at] = next[p].velocity;
      state->acceleration[at] = next[p].acceleration;
    }
  }
}

int hm_step(const hm_mesh* mesh, const hm_step_parameters* parameters, const hm_solver* solver,
            hm_state* state, hm_step_result* result) {
  const hm_formulation* formulation = parameters->formulation;
  hm_step_work work = {mesh,
                       parameters,
                       solver,
                       state,
                       &result->relaxation,
                       &result->refinement,
                       .kept = parameters->friction};
  *result = (hm_step_result){0};
  formulation->begin(&work);
  for (uint32_t expansion = 0; expansion < parameters->expansions; ++expansion) {
    const int error = formulation->relax(&work);
    if (error != HM_OK) return error;
  }
  if (formulation->weigh) formulation->weigh(&work);
  const uint32_t lost = first_lost(&work); /* asked first: then there is nothing to undo */
  if (lost != HM_PINNED) {
    result->lost_node = mesh->node_of_cell[lost];
    return HM_ERROR_LOST;
  }
  move(&work);
  if (formulation->finish) formulation->finish(&work);
  state->step += 1;
  return HM_OK;
}
