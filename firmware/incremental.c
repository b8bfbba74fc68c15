/* One time step of the incremental potential: docs/method/theory.md, section 4. Outputs are changes of
   acceleration over a scale sigma, a power of two chosen step by step so that they use their range without
   being clipped. The static rule is the same without inertia: outputs are displacements, and a step is one of
   Newton's.
 */
#include "firmware/formulations.h"

/* At rest the largest output lies between these, else the step is relaxed again at another scale. Above, the
   output stage slows down (R = 1 - |V|) and clipping is near; below, places are lost. */
static const double most_output = 0.75, least_output = 0.125;
static const double least_scale = 0x1p-200; /* the square of what it reaches still counts */
static const uint32_t most_growths = 64;
static const uint32_t most_halvings = 40;  /* of a static step that would climb */
static const double climb_allowed = 1e-12; /* of the energy: what rounding makes of none */

/* What one step is about: x = C + h da, whose inertia (kg/s^2) holds x to C. */
typedef struct increment {
  double tau, h, inertia;
  int two_steps;     /* BDF2, with a step behind it */
  double most_scale; /* growing ends here */
} increment;

/* A quadratic mesh is solved as it is, however far that is; elsewhere a step trusts its expansion no further
   than the longest spring. */
static double trusted_distance(const hm_mesh* mesh, const double* position) {
  double longest = 0;
  int exact = mesh->law == HM_LINEAR;
  for (uint32_t e = 0; e < mesh->springs; ++e) {
    const hm_spring* spring = &mesh->spring[e];
    const double *a = position + 3 * spring->node[0], *b = position + 3 * spring->node[1];
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]}, length = hm_length(d, 3);
    if (length > longest) longest = length;
    if (spring->rest_length != 0) exact = 0;
  }
  return exact ? 0x1p1000 : longest;
}

static increment increment_of(const hm_mesh* mesh, const hm_motion* motion, const hm_state* state) {
  increment in = {0, 1, 0, 0, 0x1p1000};
  if (motion->rule == HM_STATIC) {
    in.most_scale = trusted_distance(mesh, state->position);
    return in;
  }
  in.two_steps = motion->rule == HM_BDF2 && state->step > 0;
  in.tau = in.two_steps ? 2 * motion->time_step / 3 : motion->time_step;
  in.h = in.tau * in.tau / 2;
  in.inertia = motion->mass * (1 + motion->drag * in.tau) / (in.tau * in.tau);
  return in;
}

/* What acts on a coordinate of a free node beside its springs, as an acceleration. */
static double force_on(const hm_motion* motion, uint32_t node, uint32_t axis) {
  return motion->force[axis] + (motion->node_force ? motion->node_force[3 * node + axis] : 0.0);
}

/* C: where a free node would get to without springs. Backward Euler from x and v; BDF2 from (4 x - x') / 3
   and (4 v - v') / 3, with x' and v' of the step before. */
static void predict(const hm_mesh* mesh, const hm_motion* motion, const increment* in, hm_state* state) {
  const double slowed = 1 + motion->drag * in->tau;
  for (uint32_t k = 0; k < 3 * mesh->nodes; ++k) state->predicted[k] = state->position[k];
  if (motion->rule == HM_STATIC) return;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t node = mesh->node_of_cell[c], axis = mesh->axis[p], at = 3 * node + axis;
      double from = state->position[at], v = state->velocity[at];
      if (in->two_steps) {
        from = (4 * from - state->previous_position[at]) / 3;
        v = (4 * v - state->previous_velocity[at]) / 3;
      }
      state->predicted[at] = from + (in->tau * v + in->tau * in->tau * force_on(motion, node, axis)) / slowed;
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

/* The same in newtons. */
static double load(const hm_motion* motion, uint32_t node, uint32_t axis) {
  return motion->mass * force_on(motion, node, axis);
}

/* Expands about the outputs as they are. Without inertia the load has its place in the bias; else C knows. */
static void build(const hm_mesh* mesh, const hm_motion* motion, double reach, double inertia,
                  hm_state* state) {
  hm_network_build_incremental(mesh, state->predicted, reach, inertia, &state->network);
  if (motion->rule != HM_STATIC) return;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p)
      state->network.bias[c * mesh->components + p] +=
          reach * load(motion, mesh->node_of_cell[c], mesh->axis[p]);
}

/* The largest weight of a neuron to itself. */
static double largest_own(const hm_mesh* mesh, const hm_network* network) {
  double largest = 0;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const double own = magnitude(network->weight[hm_row_offset(mesh, c, p) + p]);
      if (!(own <= largest)) largest = own;
    }
  return largest;
}

/* The change of acceleration to expect: that of the step before, or else what the springs alone would give
   at C. Of a static step: what the largest pull does to the stiffest node, at least half of what is to come.
 */
static double expected_change(const hm_mesh* mesh, const hm_motion* motion, const increment* in,
                              hm_state* state) {
  const uint32_t neurons = mesh->cells * mesh->components;
  const int is_static = motion->rule == HM_STATIC;
  const double before = largest_of(state->acceleration, 3 * mesh->nodes);
  if (before > 0 && !is_static) return before;
  for (uint32_t k = 0; k < neurons; ++k) state->network.output[k] = 0;
  build(mesh, motion, 1, 0, state);
  const double pull = largest_of(state->network.bias, neurons);
  const double against = is_static ? largest_own(mesh, &state->network) : in->inertia * in->h;
  return pull > 0 ? pull / against : 0.5; /* nothing pulls: any scale will do */
}

/* V0: the change of acceleration of the step before; a static step starts from where it stands. */
static void set_expansion_point(const hm_mesh* mesh, const hm_motion* motion, hm_state* state) {
  if (motion->rule == HM_STATIC) {
    for (uint32_t k = 0; k < mesh->cells * mesh->components; ++k) state->network.output[k] = 0;
    return;
  }
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
    build(mesh, motion, in->h * state->scale, in->inertia, state);
    const int error = hm_relax(mesh, motion, solver, state, result);
    if (error != HM_OK) return error;
    const double largest = largest_of(state->network.output, mesh->cells * mesh->components);
    const double fitting = power_above(2 * largest * state->scale);
    if (largest > most_output && 2 * state->scale <= in->most_scale && growths++ < most_growths)
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
  next.velocity = 0;
  if (motion->rule == HM_STATIC) return next;
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

/* Energy of springs and load with the nodes at x; `size`: of its terms, for what rounding may do to it. */
static double potential(const hm_mesh* mesh, const hm_motion* motion, const double* x, double* size) {
  double energy = hm_spring_energy(mesh, x);
  *size = magnitude(energy);
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t node = mesh->node_of_cell[c], axis = mesh->axis[p];
      const double fall = load(motion, node, axis) * x[3 * node + axis];
      energy -= fall;
      *size += magnitude(fall);
    }
  return energy;
}

/* Downhill by the expansion is not yet downhill: a static step is halved until the energy does not rise.
   Nodes stand at x + change. */
static void halve_climb(const hm_mesh* mesh, const hm_motion* motion, hm_state* state) {
  double size;
  const double before = potential(mesh, motion, state->predicted, &size);
  for (uint32_t halvings = 0; halvings < most_halvings; ++halvings) {
    const double now = potential(mesh, motion, state->position, &size);
    if (now - before <= climb_allowed * size) return;
    for (uint32_t k = 0; k < 3 * mesh->nodes; ++k) {
      state->acceleration[k] /= 2;
      state->position[k] = state->predicted[k] + state->acceleration[k];
    }
  }
}

int hm_incremental_step(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver,
                        hm_state* state, hm_step_result* result) {
  const increment in = increment_of(mesh, motion, state);
  predict(mesh, motion, &in, state);
  const double wanted = 2 * expected_change(mesh, motion, &in, state);
  state->scale = power_above(wanted < in.most_scale ? wanted : in.most_scale);
  set_expansion_point(mesh, motion, state);
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
  if (motion->rule == HM_STATIC) halve_climb(mesh, motion, state);
  return HM_OK;
}
