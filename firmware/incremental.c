#include "firmware/incremental.h"

#include "firmware/bus.h"
#include "firmware/doubles.h"
#include "firmware/quantise.h"
#include "firmware/residual.h"

/* At rest the largest output lies between these, else the step is relaxed again at another scale. Above, the
   output stage slows down (R = 1 - |V|) and clipping is near; below, places are lost. */
static const double most_output = 0.75, least_output = 0.125;
static const uint32_t most_growths = 64;

double hm_largest(const double* values, uint32_t count) {
  double largest = 0;
  for (uint32_t k = 0; k < count; ++k)
    if (!(hm_magnitude(values[k]) <= largest)) largest = hm_magnitude(values[k]);
  return largest;
}

void hm_clear_outputs(const hm_step_work* work) {
  for (uint32_t k = 0; k < hm_neuron_count(work->mesh); ++k) work->state->network.output[k] = 0;
}

double hm_largest_own(const hm_mesh* mesh, const hm_network* network) {
  double largest = 0;
  for (uint32_t c = 0; c < mesh->cells; ++c)
    for (uint32_t p = 0; p < mesh->components; ++p) {
      const double own = hm_magnitude(network->weight[hm_row_offset(mesh, c, p) + p]);
      if (!(own <= largest)) largest = own;
    }
  return largest;
}

double hm_change_by_pull(const hm_step_work* work) {
  hm_state* state = work->state;
  hm_clear_outputs(work);
  state->scale = 1;
  work->parameters->formulation->build(work);
  const double pull = hm_largest(state->network.bias, hm_neuron_count(work->mesh));
  return pull > 0 ? pull / hm_largest_own(work->mesh, &state->network) : 0.5; /* any scale will do */
}

void hm_choose_scale(const hm_step_work* work, double expected_change) {
  const double wanted = 2 * expected_change;
  work->state->scale = hm_power_above(wanted < work->most_scale ? wanted : work->most_scale);
}

void hm_build_incremental(const hm_step_work* work) {
  hm_state* state = work->state;
  hm_network_build_incremental(work->mesh, state->predicted, work->h * state->scale, work->inertia,
                               &state->network);
}

void hm_residual_of_increment(const hm_step_work* work, const double* V, double* residual) {
  const hm_state* state = work->state;
  const hm_increment about = {state->predicted, work->h * state->scale, work->inertia, state->start};
  hm_residual(work->mesh, &about, V, residual);
}

static void rescale(const hm_step_work* work, double scale) {
  hm_state* state = work->state;
  for (uint32_t k = 0; k < hm_neuron_count(work->mesh); ++k) state->network.output[k] *= state->scale / scale;
  state->scale = scale;
}

int hm_may_grow(const hm_step_work* work, double largest) {
  return largest > most_output && 2 * work->state->scale <= work->most_scale;
}

/* At a scale that is too large for the array's words nothing moves at all, however hard it is pulled. */
static double smaller_scale(const hm_step_work* work, double largest) {
  const hm_state* state = work->state;
  if (largest > 0) return hm_power_above(2 * largest * state->scale);
  const double pull = hm_largest(state->network.bias, hm_neuron_count(work->mesh));
  return pull > 0 ? state->scale / 4 : state->scale;
}

/* Below it an output of 1 moves no node by a last place: no force is left that matters. */
static double least_useful_scale(const hm_step_work* work) {
  return 0x1p-53 * hm_largest(work->state->predicted, 3 * work->mesh->nodes) / work->h;
}

/* The scale to relax at again; the one that is where that is good enough. */
static double better_scale(const hm_step_work* work, uint32_t growths) {
  const double scale = work->state->scale;
  const double largest = hm_largest(work->state->network.output, hm_neuron_count(work->mesh));
  if (largest > most_output) return hm_may_grow(work, largest) && growths < most_growths ? 2 * scale : scale;
  if (largest >= least_output || growths > 0) return scale;
  const double smaller = smaller_scale(work, largest);
  return smaller < scale && smaller >= least_useful_scale(work) ? smaller : scale;
}

/* The scale shrinks as often as it must, then grows as often as it must; behind that it stays, so that an end
   comes. */
int hm_relax_in_range(const hm_step_work* work) {
  const hm_state* state = work->state;
  for (uint32_t growths = 0;;) {
    const int error = hm_expand(work);
    if (error != HM_OK) return error;
    const double better = better_scale(work, growths);
    if (better == state->scale) return HM_OK;
    growths += better > state->scale;
    rescale(work, better);
  }
}
