/* The probe (docs/method/theory.md, section 4): outputs are directions, and a node's springs tell how far it
 * goes.
 */
#include "firmware/doubles.h"
#include "firmware/formulation.h"
#include "firmware/network.h"
#include "firmware/springs.h"

static const double shortest_direction = 1e-9;

/* C = x + v dt + h memory a; pinned nodes stay. */
static void predict(const hm_step_work* work) {
  const hm_mesh* mesh = work->mesh;
  hm_state* state = work->state;
  const double dt = work->parameters->time_step, memory = work->parameters->acceleration_memory;
  for (uint32_t i = 0; i < mesh->nodes; ++i)
    for (uint32_t x = 3 * i; x < 3 * i + 3; ++x) {
      const double moved = state->velocity[x] * dt + work->h * memory * state->acceleration[x];
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

/* A drag slows what friction leaves: the probe's motion knows no other. */
static void begin(hm_step_work* work) {
  const hm_step_parameters* parameters = work->parameters;
  const double dt = parameters->time_step;
  work->h = dt * dt / 2;
  work->kept = parameters->friction / (1 + parameters->drag * dt);
  predict(work);
  set_expansion_point(work->mesh, work->state);
}

static void build(const hm_step_work* work) {
  const double dt = work->parameters->time_step, beta_scale = work->parameters->beta * dt * dt * dt * dt;
  hm_network_build(work->mesh, work->state->predicted, work->h, beta_scale, &work->state->network);
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
static void probe_energies(const hm_mesh* mesh, int all, double h, hm_state* state) {
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

static void weigh(const hm_step_work* work) {
  find_directions(work->mesh, work->state);
  probe_energies(work->mesh, work->parameters->energy_of_all_springs, work->h, work->state);
}

/* How strongly a cell's node is pushed (eq. 7). */
static double kick_of(const hm_step_work* work, uint32_t cell) {
  return sqrt(hm_magnitude(work->parameters->gamma * work->state->energy_change[cell]));
}

/* Position, velocity with friction, then the force. */
static void find_next(const hm_step_work* work, uint32_t cell, hm_coordinate* next) {
  const hm_mesh* mesh = work->mesh;
  const hm_step_parameters* parameters = work->parameters;
  const hm_state* state = work->state;
  const double dt = parameters->time_step, kick = kick_of(work, cell);
  for (uint32_t p = 0; p < mesh->components; ++p, ++next) {
    const uint32_t axis = mesh->axis[p], at = 3 * mesh->node_of_cell[cell] + axis;
    const double force = parameters->force[axis];
    const double a =
        state->acceleration[at] * parameters->acceleration_memory + state->direction[3 * cell + axis] * kick;
    next->position = state->position[at] + (state->velocity[at] * dt + work->h * a);
    next->velocity = (state->velocity[at] + a * dt) * work->kept;
    if (!parameters->force_on_acceleration) next->velocity += dt * force;
    next->acceleration = parameters->force_on_acceleration ? a + force : a;
  }
}

const hm_formulation hm_probe = {
    .name = "probe", .begin = begin, .build = build, .relax = hm_expand, .weigh = weigh, .next = find_next};
