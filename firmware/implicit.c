/* Backward Euler and BDF2 (docs/method/theory.md, section 4): outputs are changes of acceleration, which
   inertia holds back. */
#include "firmware/incremental.h"
#include "firmware/network.h"
#include "firmware/refine.h"
#include "firmware/springs.h"

static const uint32_t most_halvings = 40;  /* of a step that would climb */
static const double climb_allowed = 1e-12; /* of the energy: what rounding makes of none */

/* C: where a free node would get to in tau without springs. Backward Euler from x and v; BDF2 from
   (4 x - x') / 3 and (4 v - v') / 3, with x' and v' of the step before. */
static void predict(const hm_step_work* work, double tau) {
  const hm_mesh* mesh = work->mesh;
  const hm_step_parameters* parameters = work->parameters;
  hm_state* state = work->state;
  const double slowed = 1 + parameters->drag * tau;
  for (uint32_t k = 0; k < 3 * mesh->nodes; ++k) state->predicted[k] = state->position[k];
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t node = mesh->node_of_cell[c], axis = mesh->axis[p], at = 3 * node + axis;
      double from = state->position[at], v = state->velocity[at];
      if (work->two_steps) {
        from = (4 * from - state->previous_position[at]) / 3;
        v = (4 * v - state->previous_velocity[at]) / 3;
      }
      state->predicted[at] = from + (tau * v + tau * tau * hm_force_on(parameters, node, axis)) / slowed;
    }
}

/* That of the step before, or else what the pull alone tells. */
static double expected_change(const hm_step_work* work) {
  const double before = hm_largest(work->state->acceleration, 3 * work->mesh->nodes);
  return before > 0 ? before : hm_change_by_pull(work);
}

/* V0: the change of acceleration of the step before. */
static void set_expansion_point(const hm_step_work* work) {
  const hm_mesh* mesh = work->mesh;
  hm_state* state = work->state;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      state->network.output[c * mesh->components + p] =
          state->acceleration[3 * mesh->node_of_cell[c] + mesh->axis[p]] / state->scale;
}

static void begin(hm_step_work* work, double tau) {
  const hm_step_parameters* parameters = work->parameters;
  work->h = tau * tau / 2;
  work->inertia = parameters->mass * (1 + parameters->drag * tau) / (tau * tau);
  work->most_scale = 0x1p1000;
  predict(work, tau);
  hm_choose_scale(work, expected_change(work));
  set_expansion_point(work);
}

static void begin_backward_euler(hm_step_work* work) {
  begin(work, work->parameters->time_step);
}

static void begin_bdf2(hm_step_work* work) {
  const double dt = work->parameters->time_step;
  work->two_steps = work->state->step > 0;
  begin(work, work->two_steps ? 2 * dt / 3 : dt);
}

static void find_next(const hm_step_work* work, uint32_t cell, hm_coordinate* next) {
  const hm_mesh* mesh = work->mesh;
  const hm_state* state = work->state;
  const double dt = work->parameters->time_step;
  for (uint32_t p = 0; p < mesh->components; ++p, ++next) {
    const uint32_t at = 3 * mesh->node_of_cell[cell] + mesh->axis[p];
    const double x = state->position[at];
    next->acceleration = state->scale * state->network.output[cell * mesh->components + p];
    next->position = state->predicted[at] + work->h * next->acceleration;
    next->velocity = work->two_steps ? (3 * next->position - 4 * x + state->previous_position[at]) / (2 * dt)
                                     : (next->position - x) / dt;
    next->velocity *= work->kept;
  }
}

/* Springs and inertia with the nodes at x: what an implicit step looks for the least of. */
static double potential(const hm_step_work* work, const double* x) {
  const hm_mesh* mesh = work->mesh;
  double squares = 0;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t at = 3 * mesh->node_of_cell[c] + mesh->axis[p];
      const double way = x[at] - work->state->predicted[at];
      squares += way * way;
    }
  return hm_spring_energy(mesh, x) + work->inertia / 2 * squares;
}

/* Leaves the nodes a share of their way from C. */
static void shorten(const hm_step_work* work, double share) {
  const hm_mesh* mesh = work->mesh;
  hm_state* state = work->state;
  const double speed = work->kept * work->h * (work->two_steps ? 1.5 : 1.0) / work->parameters->time_step;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t at = 3 * mesh->node_of_cell[c] + mesh->axis[p];
      const double change = (share - 1) * state->acceleration[at];
      state->acceleration[at] += change;
      state->position[at] = state->predicted[at] + work->h * state->acceleration[at];
      state->velocity[at] += speed * change;
    }
}

/* An expansion knows nothing of the corner that a constant pull has where its spring shrinks to nothing, and
   may jump far beyond it: the way is halved until the step climbs no higher than C is, and given up where
   even that does not help. */
static void halve_climb(const hm_step_work* work) {
  const hm_state* state = work->state;
  if (work->mesh->law != HM_TENSION) return;
  const double most = (1 + climb_allowed) * potential(work, state->predicted);
  for (uint32_t halvings = 0; potential(work, state->position) > most; ++halvings) {
    shorten(work, halvings < most_halvings ? 0.5 : 0.0);
    if (halvings == most_halvings) return;
  }
}

const hm_formulation hm_backward_euler = {.name = "backward_euler",
                                          .begin = begin_backward_euler,
                                          .build = hm_build_incremental,
                                          .relax = hm_relax_refined,
                                          .residual = hm_residual_of_increment,
                                          .next = find_next,
                                          .finish = halve_climb};

const hm_formulation hm_bdf2 = {.name = "bdf2",
                                .looks_back = 1,
                                .begin = begin_bdf2,
                                .build = hm_build_incremental,
                                .relax = hm_relax_refined,
                                .residual = hm_residual_of_increment,
                                .next = find_next,
                                .finish = halve_climb};
