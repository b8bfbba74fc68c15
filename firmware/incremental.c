/* One time step of the incremental potential: docs/theory.md, section 4. Outputs are changes of acceleration
   over a scale sigma, a power of two chosen step by step so that they use their range without being clipped.
 */
#include "firmware/formulations.h"

/* At rest the largest output lies between these, else the step is relaxed again at another scale. Above, the
   output stage slows down (R = 1 - |V|) and clipping is near; below, places are lost. */
static const double most_output = 0.75, least_output = 0.125;
static const double least_scale = 0x1p-200; /* the square of what it reaches still counts */
static const uint32_t most_growths = 64;

/* What one step is about: x = C + h da, whose inertia (kg/s^2) holds x to C. */
typedef struct increment {
  double tau, h, inertia;
  int two_steps; /* BDF2, with a step behind it */
} increment;

static increment increment_of(const hm_motion* motion, const hm_state* state) {
  increment in;
  in.two_steps = motion->rule == HM_BDF2 && state->step > 0;
  in.tau = in.two_steps ? 2 * motion->time_step / 3 : motion->time_step;
  in.h = in.tau * in.tau / 2;
  in.inertia = motion->mass * (1 + motion->drag * in.tau) / (in.tau * in.tau);
  return in;
}

/* C: where a free node would get to without springs. Backward Euler from x and v; BDF2 from (4 x - x') / 3
   and (4 v - v') / 3, with x' and v' of the step before. */
static void predict(const hm_mesh* mesh, const hm_motion* motion, const increment* in, hm_state* state) {
  const double slowed = 1 + motion->drag * in->tau;
  for (uint32_t k = 0; k < 3 * mesh->nodes; ++k) state->predicted[k] = state->position[k];
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t axis = mesh->axis[p], at = 3 * mesh->node_of_cell[c] + axis;
      double from = state->position[at], v = state->velocity[at];
      if (in->two_steps) {
        from = (4 * from - state->previous_position[at]) / 3;
        v = (4 * v - state->previous_velocity[at]) / 3;
      }
      state->predicted[at] = from + (in->tau * v + in->tau * in->tau * motion->force[axis]) / slowed;
    }
}

static double magnitude(double x) {
  return x < 0 ? -x : x;
}

static double largest_of(const double* values, uint32_t count) {
  double largest = 0;
  for (uint32_t k = 0; k < count; ++k)
    if (!(magnitude(values[k]) <= largest)) largest = magnitude(values[k]); /* not a number: kept */
  return largest;
}

/* The least power of two that is at least x, and at least least_scale; x where it is not finite. */
static double power_above(double x) {
  double power = 1;
  if (!hm_is_finite(x)) return x;
  while (power < x) power *= 2;
  while (power / 2 >= x && power > least_scale) power /= 2;
  return power;
}

/* The change of acceleration to expect: that of the step before, or else what the springs alone would give
   at C. */
static double expected_change(const hm_mesh* mesh, const increment* in, hm_state* state) {
  const uint32_t neurons = mesh->cells * mesh->components;
  const double before = largest_of(state->acceleration, 3 * mesh->nodes);
  if (before > 0) return before;
  for (uint32_t k = 0; k < neurons; ++k) state->network.output[k] = 0;
  hm_network_build_incremental(mesh, state->predicted, 1, 0, &state->network);
  const double pull = largest_of(state->network.bias, neurons);
  return pull > 0 ? pull / (in->inertia * in->h) : 0.5; /* nothing pulls: any scale will do */
}

/* V0: the change of acceleration of the step before. */
static void set_expansion_point(const hm_mesh* mesh, hm_state* state) {
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      state->network.output[c * mesh->components + p] =
          state->acceleration[3 * mesh->node_of_cell[c] + mesh->axis[p]] / state->scale;
}

static void rescale(const hm_mesh* mesh, hm_state* state, double scale) {
  for (uint32_t k = 0; k < mesh->cells * mesh->components; ++k)
    state->network.output[k] *= state->scale / scale;
  state->scale = scale;
}

/* Expands and relaxes until the largest output is within its bounds: the scale may grow as often as it must,
   and shrink once. */
static int relax_in_range(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver,
                          const increment* in, hm_state* state, hm_step_result* result) {
  int shrunk = 0;
  for (uint32_t growths = 0;;) {
    hm_keep_start(mesh, state);
    hm_network_build_incremental(mesh, state->predicted, in->h * state->scale, in->inertia, &state->network);
    const int error = hm_relax(mesh, motion, solver, state, result);
    if (error != HM_OK) return error;
    const double largest = largest_of(state->network.output, mesh->cells * mesh->components);
    const double fitting = power_above(2 * largest * state->scale);
    if (largest > most_output && growths++ < most_growths)
      rescale(mesh, state, 2 * state->scale);
    else if (largest > 0 && largest < least_output && !shrunk++ && fitting < state->scale)
      rescale(mesh, state, fitting);
    else
      return HM_OK;
  }
}

typedef struct coordinate {
  double position, velocity, acceleration;
} coordinate;

static coordinate moved(const hm_motion* motion, const increment* in, const hm_state* state, uint32_t at,
                        double output) {
  coordinate next;
  next.acceleration = state->scale * output;
  next.position = state->predicted[at] + in->h * next.acceleration;
  const double x = state->position[at];
  next.velocity = in->two_steps
                      ? (3 * next.position - 4 * x + state->previous_position[at]) / (2 * motion->time_step)
                      : (next.position - x) / motion->time_step;
  next.velocity *= motion->friction;
  return next;
}

/* The first cell whose node would have no finite place or velocity; HM_PINNED if there is none. */
static uint32_t first_lost(const hm_mesh* mesh, const hm_motion* motion, const increment* in,
                           const hm_state* state) {
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const coordinate next = moved(motion, in, state, 3 * mesh->node_of_cell[c] + mesh->axis[p],
                                    state->network.output[c * mesh->components + p]);
      if (!hm_is_finite(next.position) || !hm_is_finite(next.velocity)) return c;
    }
  return HM_PINNED;
}

static void move(const hm_mesh* mesh, const hm_motion* motion, const increment* in, hm_state* state) {
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t at = 3 * mesh->node_of_cell[c] + mesh->axis[p];
      const coordinate next = moved(motion, in, state, at, state->network.output[c * mesh->components + p]);
      if (motion->rule == HM_BDF2) {
        state->previous_position[at] = state->position[at];
        state->previous_velocity[at] = state->velocity[at];
      }
      state->position[at] = next.position;
      state->velocity[at] = next.velocity;
      state->acceleration[at] = next.acceleration;
    }
}

int hm_incremental_step(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver,
                        hm_state* state, hm_step_result* result) {
  const increment in = increment_of(motion, state);
  predict(mesh, motion, &in, state);
  state->scale = power_above(2 * expected_change(mesh, &in, state));
  set_expansion_point(mesh, state);
  for (uint32_t expansion = 0; expansion < motion->expansions; ++expansion) {
    const int error = relax_in_range(mesh, motion, solver, &in, state, result);
    if (error != HM_OK) return error;
  }
  const uint32_t lost = first_lost(mesh, motion, &in, state); /* asked first: then there is nothing to undo */
  if (lost != HM_PINNED) {
    result->lost_node = mesh->node_of_cell[lost];
    return HM_ERROR_LOST;
  }
  move(mesh, motion, &in, state);
  return HM_OK;
}
