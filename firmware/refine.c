#include "firmware/refine.h"

#include "firmware/bus.h"
#include "firmware/doubles.h"
#include "firmware/incremental.h"
#include "firmware/quantise.h"
#include "firmware/try.h"

/* A correction is expected to use so much of the array's range: what clips is lost until the next one. */
static const double wanted_change = 0.5;
/* From here on an answer counts as clipped; the next correction expects so many times more. */
static const double clipped_change = 0.875, caution = 8;
static const double least_softening = 0.0625; /* of what is expected, in one step */
static const uint32_t most_halvings = 8;      /* of a correction that meets the box */
static const double rounding = 0x1p-40;       /* of an output: a correction of less may be noise of doubles */

/* A correction in the making; all arrays [cells * components], in the state's room. */
typedef struct correcting {
  const hm_step_work* work;
  double *residual, *change, *next, *trial;
  double sigma; /* what a change of 1 in the array adds to V, a power of two */
  double ratio; /* W of the step over W of the array, a power of two */
  int clamps;   /* the trial meets the box */
} correcting;

static correcting begin(const hm_step_work* work) {
  const uint32_t neurons = hm_neuron_count(work->mesh);
  double* room = work->state->correction;
  return (correcting){.work = work,
                      .residual = room,
                      .change = room + neurons,
                      .next = room + 2 * neurons,
                      .trial = room + 3 * neurons};
}

static double reach(const hm_step_work* work) {
  return work->h * work->state->scale;
}

static void find_residual(const correcting* c, const double* V, double* residual) {
  c->work->parameters->formulation->residual(c->work, V, residual);
}

/* A neuron at a bound that its residual pushes against. */
static int is_held(double V, double residual) {
  return (V >= 1 && residual > 0) || (V <= -1 && residual < 0);
}

static double largest_residual(const correcting* c) {
  const double* V = c->work->state->network.output;
  double largest = 0;
  for (uint32_t k = 0; k < hm_neuron_count(c->work->mesh); ++k)
    if (!is_held(V[k], c->residual[k]) && !(hm_magnitude(c->residual[k]) <= largest))
      largest = hm_magnitude(c->residual[k]);
  return largest;
}

/* ---- what the array is asked */

/* What the softness makes of the residual; where nothing is known of it, what a neuron alone would do. */
static double expected_change(const correcting* c, double largest) {
  const hm_state* state = c->work->state;
  const double r = reach(c->work);
  if (state->kept.softness > 0) return largest * state->kept.softness / (r * r);
  return largest * caution / hm_largest_own(c->work->mesh, &state->network);
}

static void choose_sigma(correcting* c, double largest) {
  const hm_solver* solver = c->work->solver;
  const double q = reach(c->work) / c->work->state->kept.reach, least = largest / (q * q);
  c->ratio = q * q;
  c->sigma = hm_power_above(expected_change(c, largest) / wanted_change);
  while (c->sigma * solver->room(solver->context) < least) c->sigma *= 2;
}

/* The neuron's row in the step's W: `at` of its entries, and whose output each one weighs. */
static uint32_t source_of(const hm_mesh* mesh, uint32_t cell, uint32_t entry) {
  const uint32_t n = mesh->components, block = entry / n;
  return (block == 0 ? cell : mesh->link_to[mesh->first_link[cell] + block - 1]) * n + entry % n;
}

/* A held neuron stands at +1 in the array, pushed by a bias above the sum of its weights, and its neighbours'
   biases lose what it does to them there: to them it has not moved, and the host takes no change from it. */
static void take_away(correcting* c, uint32_t cell, uint32_t p) {
  const hm_mesh* mesh = c->work->mesh;
  const double* row = c->work->state->network.weight + hm_row_offset(mesh, cell, p);
  for (uint32_t k = 0; k < hm_row_length(mesh, cell); ++k)
    c->next[source_of(mesh, cell, k)] -= row[k] / c->ratio;
}

static void hold(correcting* c, uint32_t cell, uint32_t p) {
  const hm_mesh* mesh = c->work->mesh;
  const hm_solver* solver = c->work->solver;
  const uint32_t neuron = cell * mesh->components + p;
  const double* row = c->work->state->network.weight + hm_row_offset(mesh, cell, p);
  const double room = solver->room(solver->context);
  double sum = 0;
  for (uint32_t k = 0; k < hm_row_length(mesh, cell); ++k) sum += hm_magnitude(row[k]);
  const double push = 2 * sum / c->ratio;
  c->next[neuron] = push < room ? push : room;
  c->change[neuron] = 1;
}

/* For every held neuron, in turn. */
static void for_held(correcting* c, void (*what)(correcting* c, uint32_t cell, uint32_t p)) {
  const hm_mesh* mesh = c->work->mesh;
  const double* V = c->work->state->network.output;
  for (uint32_t cell = 0, k = 0; cell < mesh->cells; ++cell)
    for (uint32_t p = 0; p < mesh->components; ++p, ++k)
      if (is_held(V[k], c->residual[k])) what(c, cell, p);
}

static void ask(correcting* c) {
  for (uint32_t k = 0; k < hm_neuron_count(c->work->mesh); ++k) {
    c->next[k] = c->residual[k] / c->ratio / c->sigma;
    c->change[k] = 0;
  }
  for_held(c, take_away);
  for_held(c, hold);
}

static int answer(correcting* c) {
  const hm_step_work* work = c->work;
  const hm_step_parameters* parameters = work->parameters;
  hm_network asked = {work->state->network.weight, c->next, c->change};
  hm_relaxation one;
  TRY(work->solver->correct(work->solver->context, work->mesh, &asked, parameters->threshold,
                            parameters->max_sweeps, &one));
  hm_add_relaxation(work->relaxation, &one);
  return HM_OK;
}

static void leave_held(correcting* c, uint32_t cell, uint32_t p) {
  c->change[cell * c->work->mesh->components + p] = 0;
}

/* How far the residual has moved the outputs: what the next correction expects. */
static void learn(const correcting* c, double largest) {
  hm_kept* kept = &c->work->state->kept;
  const double moved = hm_largest(c->change, hm_neuron_count(c->work->mesh));
  const double r = reach(c->work), expected = expected_change(c, largest);
  double found = c->sigma * moved * (moved >= clipped_change ? caution : 1);
  if (found < least_softening * expected) found = least_softening * expected;
  kept->softness = found / largest * (r * r);
}

/* ---- what the host makes of the answer */

/* trial = V and so much of the correction, within the box. */
static void try_share(correcting* c, double share) {
  const double* V = c->work->state->network.output;
  c->clamps = 0;
  for (uint32_t k = 0; k < hm_neuron_count(c->work->mesh); ++k) {
    const double at = V[k] + share * c->sigma * c->change[k];
    c->trial[k] = at > 1 ? 1 : at < -1 ? -1 : at;
    c->clamps |= c->trial[k] != at;
  }
}

static double largest_beyond(const correcting* c) {
  const double* V = c->work->state->network.output;
  double largest = 0;
  for (uint32_t k = 0; k < hm_neuron_count(c->work->mesh); ++k) {
    const double at = hm_magnitude(V[k] + c->sigma * c->change[k]);
    if (!(at <= largest)) largest = at;
  }
  return largest;
}

/* The host's V is no code, so a larger scale loses nothing: the network is built anew about the same point,
   for those who judge the step, and the array hears nothing of it. */
static void make_room(correcting* c) {
  const hm_step_work* work = c->work;
  hm_state* state = work->state;
  const uint32_t neurons = hm_neuron_count(work->mesh);
  int grown = 0;
  while (hm_may_grow(work, largest_beyond(c))) {
    for (uint32_t k = 0; k < neurons; ++k) state->network.output[k] /= 2, state->start[k] /= 2;
    state->scale *= 2, c->sigma /= 2, grown = 1;
  }
  if (!grown) return;
  for (uint32_t k = 0; k < neurons; ++k) c->trial[k] = state->network.output[k];
  for (uint32_t k = 0; k < neurons; ++k) state->network.output[k] = state->start[k];
  work->parameters->formulation->build(work);
  for (uint32_t k = 0; k < neurons; ++k) state->network.output[k] = c->trial[k];
  find_residual(c, state->network.output, c->residual);
}

/* What the network's energy falls by on the way from V to the trial: the way times the mean of the residuals
   at its ends. next becomes the residual at the trial. */
static double fall(const correcting* c) {
  const double* V = c->work->state->network.output;
  double sum = 0;
  find_residual(c, c->trial, c->next);
  for (uint32_t k = 0; k < hm_neuron_count(c->work->mesh); ++k)
    sum += (c->trial[k] - V[k]) * (c->residual[k] + c->next[k]) / 2;
  return sum;
}

/* Takes the correction, or a share of it where the box cuts it short; 0 where the energy would rise. */
static int take(correcting* c) {
  hm_state* state = c->work->state;
  make_room(c);
  double share = 1;
  try_share(c, share);
  double fallen = fall(c);
  for (uint32_t k = 0; k < most_halvings && !(fallen > 0) && c->clamps; ++k) {
    share /= 2;
    try_share(c, share);
    fallen = fall(c);
  }
  if (!(fallen > 0)) return 0;
  for (uint32_t k = 0; k < hm_neuron_count(c->work->mesh); ++k) {
    state->network.output[k] = c->trial[k];
    c->residual[k] = c->next[k];
  }
  return 1;
}

static int is_noise(const correcting* c) {
  return c->sigma * hm_largest(c->change, hm_neuron_count(c->work->mesh)) <= rounding;
}

/* Corrects V until nothing is left, so often, or until a correction would raise the energy; `made` of them
   were good. */
static int correct(const hm_step_work* work, uint32_t most, uint32_t* made) {
  hm_state* state = work->state;
  correcting c = begin(work);
  double largest;
  find_residual(&c, state->network.output, c.residual);
  for (*made = 0; (largest = largest_residual(&c)) > 0 && *made < most; *made += 1) {
    choose_sigma(&c, largest);
    ask(&c);
    TRY(answer(&c));
    for_held(&c, leave_held);
    learn(&c, largest);
    if (take(&c)) continue;
    work->refinement->refused += !is_noise(&c);
    break;
  }
  const double whole = hm_largest(state->network.bias, hm_neuron_count(work->mesh));
  work->refinement->residual = whole > 0 ? largest / whole : 0;
  if (largest == 0) work->relaxation->converged = 1;
  return HM_OK;
}

/* ---- a step's expansion */

/* The array's answer from its own words. */
static int load_and_relax(const hm_step_work* work) {
  hm_kept* kept = &work->state->kept;
  kept->reach = 0;
  TRY(hm_relax_in_range(work));
  kept->reach = reach(work);
  kept->inertia = work->inertia;
  kept->step = work->state->step;
  return HM_OK;
}

static int may_keep(const hm_step_work* work) {
  const hm_kept* kept = &work->state->kept;
  return work->parameters->reload_every > 1 && kept->reach > 0 && kept->inertia == work->inertia &&
         work->state->step - kept->step < work->parameters->reload_every;
}

/* The first correction, from the expansion point, stands for the answer. */
static int correct_with_kept(const hm_step_work* work, int* good) {
  hm_state* state = work->state;
  const uint32_t refused = work->refinement->refused;
  uint32_t made;
  for (uint32_t k = 0; k < hm_neuron_count(work->mesh); ++k) state->start[k] = state->network.output[k];
  work->parameters->formulation->build(work);
  TRY(correct(work, work->parameters->refinements + 1, &made));
  work->refinement->corrections += made > 0 ? made - 1 : 0;
  *good = work->refinement->refused == refused;
  return HM_OK;
}

int hm_relax_refined(const hm_step_work* work) {
  const hm_step_parameters* parameters = work->parameters;
  hm_state* state = work->state;
  const int corrects = parameters->refinements > 0 || parameters->reload_every > 1;
  if (!corrects || !work->solver->correct) return hm_relax_in_range(work);
  if (may_keep(work)) {
    int good;
    TRY(correct_with_kept(work, &good));
    if (good) return HM_OK;
    for (uint32_t k = 0; k < hm_neuron_count(work->mesh); ++k) state->network.output[k] = state->start[k];
  }
  uint32_t made;
  TRY(load_and_relax(work));
  TRY(correct(work, parameters->refinements, &made));
  work->refinement->corrections += made;
  return HM_OK;
}
