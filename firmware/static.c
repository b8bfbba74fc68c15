/* The static step (docs/method/theory.md, section 4): outputs are displacements towards the least potential
   energy, nothing has a speed, and a step is one of Newton's. */
#include "firmware/doubles.h"
#include "firmware/incremental.h"
#include "firmware/refine.h"
#include "firmware/springs.h"

static const uint32_t most_halvings = 40;  /* of a step that would climb */
static const double climb_allowed = 1e-12; /* of the energy: what rounding makes of none */

/* Newtons. */
static double load(const hm_step_parameters* parameters, uint32_t node, uint32_t axis) {
  return parameters->mass * hm_force_on(parameters, node, axis);
}

/* Without inertia no prediction knows the load: its place is in the bias. */
static void build(const hm_step_work* work) {
  const hm_mesh* mesh = work->mesh;
  hm_state* state = work->state;
  hm_build_incremental(work);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      state->network.bias[c * mesh->components + p] +=
          state->scale * load(work->parameters, mesh->node_of_cell[c], mesh->axis[p]);
}

static void find_residual(const hm_step_work* work, const double* V, double* residual) {
  const hm_mesh* mesh = work->mesh;
  hm_residual_of_increment(work, V, residual);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      residual[c * mesh->components + p] +=
          work->state->scale * load(work->parameters, mesh->node_of_cell[c], mesh->axis[p]);
}

/* A quadratic mesh is solved as it is, however far that is; elsewhere a step trusts its expansion no further
   than the longest spring. */
static void begin(hm_step_work* work) {
  const hm_mesh* mesh = work->mesh;
  hm_state* state = work->state;
  work->h = 1;
  work->most_scale = hm_springs_are_quadratic(mesh) ? 0x1p1000 : hm_longest_spring(mesh, state->position);
  for (uint32_t k = 0; k < 3 * mesh->nodes; ++k) state->predicted[k] = state->position[k];
  hm_choose_scale(work, hm_change_by_pull(work)); /* it leaves V0 = 0 */
}

static void find_next(const hm_step_work* work, uint32_t cell, hm_coordinate* next) {
  const hm_mesh* mesh = work->mesh;
  const hm_state* state = work->state;
  for (uint32_t p = 0; p < mesh->components; ++p, ++next) {
    const uint32_t at = 3 * mesh->node_of_cell[cell] + mesh->axis[p];
    next->acceleration = state->scale * state->network.output[cell * mesh->components + p];
    next->position = state->predicted[at] + next->acceleration;
    next->velocity = 0;
  }
}

/* Energy of springs and load with the nodes at x; `size`: of its terms, for what rounding may do to it. */
static double potential(const hm_step_work* work, const double* x, double* size) {
  const hm_mesh* mesh = work->mesh;
  double energy = hm_spring_energy(mesh, x);
  *size = hm_magnitude(energy);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t node = mesh->node_of_cell[c], axis = mesh->axis[p];
      const double fall = load(work->parameters, node, axis) * x[3 * node + axis];
      energy -= fall;
      *size += hm_magnitude(fall);
    }
  return energy;
}

/* Downhill by the expansion is not yet downhill: the way is halved until the energy does not rise. */
static void halve_climb(const hm_step_work* work) {
  hm_state* state = work->state;
  double size;
  const double before = potential(work, state->predicted, &size);
  for (uint32_t halvings = 0; halvings < most_halvings; ++halvings) {
    const double now = potential(work, state->position, &size);
    if (now - before <= climb_allowed * size) return;
    for (uint32_t k = 0; k < 3 * work->mesh->nodes; ++k) {
      state->acceleration[k] /= 2;
      state->position[k] = state->predicted[k] + state->acceleration[k];
    }
  }
}

const hm_formulation hm_static = {.name = "static",
                                  .begin = begin,
                                  .build = build,
                                  .relax = hm_relax_refined,
                                  .residual = find_residual,
                                  .next = find_next,
                                  .finish = halve_climb};
