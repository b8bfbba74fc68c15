/* One time step of the probe formulation: docs/method/theory.md, section 4. */
#include "firmware/formulations.h"

double sqrt(double);

static const double shortest_direction = 1e-9;

/* C = x + v dt + h memory a; pinned nodes stay. */
static void predict(const hm_mesh* mesh, const hm_motion* motion, hm_state* state) {
  const double dt = motion->time_step, h = dt * dt / 2;
  for (uint32_t i = 0; i < mesh->nodes; ++i)
    for (uint32_t x = 3 * i; x < 3 * i + 3; ++x) {
      const double moved = state->velocity[x] * dt + h * motion->acceleration_memory * state->acceleration[x];
      state->predicted[x] = state->position[x] + (mesh->cell_of_node[i] == HM_PINNED ? 0.0 : moved);
    }
}

/* V0: the previous rest state scaled to unit length; straight down (the last component) where it has no
 * direction. */
static void set_expansion_point(const hm_mesh* mesh, hm_state* state) {
  const uint32_t n = mesh->components;
  for (uint32_t c = 0; c < mesh->cells; ++c) {
    double* v = state->network.output + c * n;
    const double length = state->step == 0 ? 0.0 : hm_length(v, n);
    for (uint32_t p = 0; p < n; ++p)
      v[p] = length < shortest_direction ? (p + 1 == n ? -1.0 : 0.0) : v[p] / length;
  }
}

/* The directions that the nodes' neurons rest in, in coordinates; zero where they point nowhere. */
static void find_directions(const hm_mesh* mesh, hm_state* state) {
  const uint32_t n = mesh->components;
  for (uint32_t c = 0; c < mesh->cells; ++c) {
    const double* v = state->network.output + c * n;
    double* direction = state->direction + 3 * c;
    const double length = hm_length(v, n);
    direction[0] = direction[1] = direction[2] = 0;
    if (length < shortest_direction) continue;
    for (uint32_t p = 0; p < n; ++p) direction[mesh->axis[p]] = v[p] / length;
  }
}

/* Adds to energy_change[cell], for one end of a spring: the spring with this node probed, minus `before`. */
static void probe_end(const hm_mesh* mesh, const hm_spring* spring, int end, double h, hm_state* state,
                      double before) {
  const uint32_t node = spring->node[end], cell = mesh->cell_of_node[node];
  if (cell == HM_PINNED) return;
  const double* direction = state->direction + 3 * cell;
  double probed[3];
  for (uint32_t x = 0; x < 3; ++x) probed[x] = state->predicted[3 * node + x] + h * direction[x];
  state->energy_change[cell] +=
      hm_one_spring_energy(mesh, spring, probed, state->predicted + 3 * spring->node[1 - end]) - before;
}

/* Delta E_i of every cell (paper eq. 6). With `all springs`, the springs elsewhere change by E(C) - E(x): the
   total, less what the node's own springs contribute to it. */
static void probe_energies(const hm_mesh* mesh, const hm_motion* motion, hm_state* state) {
  const double h = motion->time_step * motion->time_step / 2;
  const int all = motion->energy_of_all_springs;
  const double elsewhere =
      all ? hm_spring_energy(mesh, state->predicted) - hm_spring_energy(mesh, state->position) : 0.0;
  for (uint32_t c = 0; c < mesh->cells; ++c) state->energy_change[c] = elsewhere;
  for (uint32_t e = 0; e < mesh->springs; ++e) {
    const hm_spring* spring = &mesh->spring[e];
    const double* at = all ? state->predicted : state->position;
    const double before =
        hm_one_spring_energy(mesh, spring, at + 3 * spring->node[0], at + 3 * spring->node[1]);
    probe_end(mesh, spring, 0, h, state, before);
    probe_end(mesh, spring, 1, h, state, before);
  }
}

/* How strongly a cell's node is pushed (eq. 7). */
static double kick_of(const hm_motion* motion, const hm_state* state, uint32_t cell) {
  const double energy = motion->gamma * state->energy_change[cell];
  return sqrt(energy < 0 ? -energy : energy);
}

typedef struct coordinate {
  double position, velocity, acceleration;
} coordinate;

/* Position, velocity with friction, then the force, of one coordinate of a free node. */
static coordinate moved(const hm_motion* motion, const hm_state* state, uint32_t at, uint32_t axis,
                        double push) {
  const double dt = motion->time_step, h = dt * dt / 2;
  const double a = state->acceleration[at] * motion->acceleration_memory + push;
  coordinate next;
  next.position = state->position[at] + (state->velocity[at] * dt + h * a);
  next.velocity = (state->velocity[at] + a * dt) * motion->friction;
  if (!motion->force_on_acceleration) next.velocity += dt * motion->force[axis];
  next.acceleration = motion->force_on_acceleration ? a + motion->force[axis] : a;
  return next;
}

/* The first cell whose node would have no finite place or velocity; HM_PINNED if there is none. */
static uint32_t first_lost(const hm_mesh* mesh, const hm_motion* motion, const hm_state* state) {
  for (uint32_t c = 0; c < mesh->cells; ++c) {
    const double kick = kick_of(motion, state, c);
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t x = mesh->axis[p];
      const coordinate next =
          moved(motion, state, 3 * mesh->node_of_cell[c] + x, x, state->direction[3 * c + x] * kick);
      if (!hm_is_finite(next.position) || !hm_is_finite(next.velocity)) return c;
    }
  }
  return HM_PINNED;
}

static void move(const hm_mesh* mesh, const hm_motion* motion, hm_state* state) {
  for (uint32_t c = 0; c < mesh->cells; ++c) {
    const double kick = kick_of(motion, state, c);
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const uint32_t x = mesh->axis[p], at = 3 * mesh->node_of_cell[c] + x;
      const coordinate next = moved(motion, state, at, x, state->direction[3 * c + x] * kick);
      state->position[at] = next.position;
      state->velocity[at] = next.velocity;
      state->acceleration[at] = next.acceleration;
    }
  }
}

int hm_probe_step(const hm_mesh* mesh, const hm_motion* motion, const hm_solver* solver, hm_state* state,
                  hm_step_result* result) {
  const double dt = motion->time_step, h = dt * dt / 2, beta_scale = motion->beta * dt * dt * dt * dt;
  predict(mesh, motion, state);
  set_expansion_point(mesh, state);
  for (uint32_t expansion = 0; expansion < motion->expansions; ++expansion) {
    hm_keep_start(mesh, state);
    hm_network_build(mesh, state->predicted, h, beta_scale, &state->network);
    const int error = hm_relax(mesh, motion, solver, state, result);
    if (error != HM_OK) return error;
  }
  find_directions(mesh, state);
  probe_energies(mesh, motion, state);
  const uint32_t lost = first_lost(mesh, motion, state); /* asked first: then there is nothing to undo */
  if (lost != HM_PINNED) {
    result->lost_node = mesh->node_of_cell[lost];
    return HM_ERROR_LOST;
  }
  move(mesh, motion, state);
  return HM_OK;
}
