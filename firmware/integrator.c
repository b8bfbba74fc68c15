/* The time step, whatever its formulation. */
#include "firmware/integrator.h"

#include "firmware/formulations.h"

double sqrt(double);

double hm_length(const double* v, uint32_t n) {
  double square = 0;
  for (uint32_t p = 0; p < n; ++p) square += v[p] * v[p];
  return sqrt(square);
}

int hm_is_finite(double x) {
  return x - x == 0;
}

double hm_one_spring_energy(const hm_mesh* mesh, const hm_spring* spring, const double* a, const double* b) {
  const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  if (mesh->law == HM_TENSION) {
    const double length = hm_length(d, 3);
    return spring->weight * sqrt(length * length + mesh->floor * mesh->floor);
  }
  const double stretch = hm_length(d, 3) - spring->rest_length;
  return spring->weight * stretch * stretch;
}

double hm_spring_energy(const hm_mesh* mesh, const double* position) {
  double sum = 0;
  for (uint32_t e = 0; e < mesh->springs; ++e)
    sum += hm_one_spring_energy(mesh, &mesh->spring[e], position + 3 * mesh->spring[e].node[0],
                                position + 3 * mesh->spring[e].node[1]);
  return sum;
}

void hm_keep_start(const hm_mesh* mesh, hm_state* state) {
  for (uint32_t k = 0; k < mesh->cells * mesh->components; ++k) state->start[k] = state->network.output[k];
}

int hm_relax(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver, hm_state* state,
             hm_step_result* result) {
  hm_relaxation relaxation;
  const int error = solver->relax(solver->context, mesh, &state->network, motion->threshold,
                                  motion->max_sweeps, &relaxation);
  if (error != HM_OK) return error;
  result->sweeps += relaxation.sweeps;
  result->cycles += relaxation.cycles;
  result->converged = relaxation.converged;
  result->relaxations += 1;
  return HM_OK;
}

int hm_step(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver, hm_state* state,
            hm_step_result* result) {
  *result = (hm_step_result){0};
  const int error = motion->rule == HM_PROBE ? hm_probe_step(mesh, motion, solver, state, result)
                                             : hm_incremental_step(mesh, motion, solver, state, result);
  if (error == HM_OK) state->step += 1;
  return error;
}
