#include "firmware/incremental.h"

#include "firmware/bus.h"
#include "firmware/doubles.h"
#include "firmware/network.h"

/* At rest the largest output lies between these, else the step is relaxed again at another scale. Above, the
   output stage slows down (R = 1 - |V|) and clipping is near; below, places are lost. */
static const double most_output = 0.75, least_output = 0.125;
static const double least_scale = 0x1p-200; /* the square of what it reaches still counts */
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

/* The least power of two that is at least x, and at least least_scale; x where it is not finite. */
static double power_above(double x) {
  double power = 1;
  if (!hm_is_finite(x)) return x;
  while (power < x) power *= 2;
  while (power / 2 >= x && power > least_scale) power /= 2;
  return power;
}

void hm_choose_scale(const hm_step_work* work, double expected_change) {
  const double wanted = 2 * expected_change;
  work->state->scale = power_above(wanted < work->most_scale ? wanted : work->most_scale);
}

void hm_build_incremental(const hm_step_work* work) {
  hm_state* state = work->state;
  hm_network_build_incremental(work->mesh, state->predicted, work->h * state->scale, work->inertia,
                               &state->network);
}

static void rescale(const hm_step_work* work, double scale) {
  hm_state* state = work->state;
  for (uint32_t k = 0; k < hm_neuron_count(work->mesh); ++k) state->network.output[k] *= state->scale / scale;
  state->scale = scale;
}

/* The scale may grow as often as it must, and shrink once. */
int hm_relax_in_range(const hm_step_work* work) {
  const hm_state* state = work->state;
  int shrunk = 0;
  for (uint32_t growths = 0;;) {
    const int error = hm_expand(work);
    if (error != HM_OK) return error;
    const double largest = hm_largest(state->network.output, hm_neuron_count(work->mesh));
    const double fitting = power_above(2 * largest * state->scale);
    if (largest > most_output && 2 * state->scale <= work->most_scale && growths++ < most_growths)
      rescale(work, 2 * state->scale);
    else if (largest > 0 && largest < least_output && !shrunk++ && fitting < state->scale)
      rescale(work, fitting);
    else
      return HM_OK;
  }
}
