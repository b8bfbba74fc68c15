/* Backward Euler in whole numbers (docs/method/theory.md, section 4): outputs are changes of acceleration
   over a scale, a power of two. The rules that choose it are those of incremental.c. */
#include "firmware/fixed/fixed_parts.h"

static const int32_t unit = 1 << HM_FIXED_OUTPUT;
static const uint32_t most_growths = 64;

static int32_t largest_of(const int32_t* values, uint32_t count) {
  int32_t largest = 0;
  for (uint32_t k = 0; k < count; ++k)
    if (hm_magnitude_of(values[k]) > largest) largest = hm_magnitude_of(values[k]);
  return largest;
}

/* C: where a free node would get to without springs. */
static void predict(const hm_fixed_work* work) {
  const hm_fixed_plan* plan = work->plan;
  hm_fixed_state* state = work->state;
  for (uint32_t k = 0; k < 3 * plan->nodes; ++k) state->predicted[k] = state->position[k];
  for (uint32_t c = 0; c < plan->cells; ++c)
    for (uint32_t p = 0, at = 3 * work->mesh->node[c].node; p < 3; ++p, ++at) {
      const int32_t way = (int32_t)((int64_t)state->way[at] * plan->slowed >> 30) + plan->fall[p];
      state->predicted[at] += hm_rounded_down(way, HM_FIXED_FINER);
    }
}

/* The least exponent of a power of two that is at least a / b, of positive numbers. */
static int32_t power_above(uint64_t a, uint64_t b) {
  int32_t exponent = 0;
  while (a >> 62 == 0 && a < b) a <<= 1, --exponent;
  while (b >> 62 == 0 && b < a) b <<= 1, ++exponent;
  return a == b ? exponent : b > a ? exponent : exponent + 1;
}

static int32_t within(const hm_fixed_plan* plan, int32_t exponent) {
  if (exponent > plan->most_scale) return plan->most_scale;
  return exponent < plan->least_scale ? plan->least_scale : exponent;
}

static uint64_t largest_bias(const hm_fixed_work* work) {
  int64_t largest = 0;
  for (uint32_t k = 0; k < 3 * work->plan->cells; ++k) {
    const int64_t b = work->state->bias[k], size = b < 0 ? -b : b;
    if (size > largest) largest = size;
  }
  return (uint64_t)largest;
}

static uint64_t largest_own(const hm_fixed_work* work) {
  int32_t largest = 0;
  for (uint32_t c = 0; c < work->plan->cells; ++c) {
    const hm_fixed_node* node = &work->mesh->node[c];
    for (uint32_t p = 0; p < 3; ++p) {
      const int32_t own = hm_magnitude_of(work->state->weight[node->own + p * node->row + p]);
      if (own > largest) largest = own;
    }
  }
  return (uint64_t)largest;
}

/* Half the range for what the largest pull does to the stiffest node. */
static int choose_by_pull(const hm_fixed_work* work, uint32_t* lost_node) {
  hm_fixed_state* state = work->state;
  for (uint32_t k = 0; k < 3 * work->plan->cells; ++k) state->start[k] = 0;
  state->scale_exponent = within(work->plan, 0);
  TRY(hm_fixed_build(work, lost_node));
  const uint64_t pull = largest_bias(work), own = largest_own(work);
  const int32_t finer = HM_FIXED_WEIGHT + 1 - state->bias_places; /* twice pull over own */
  if (pull > 0 && own > 0)
    state->scale_exponent = within(work->plan, state->scale_exponent + finer + power_above(pull, own));
  return HM_OK;
}

static int choose_scale(const hm_fixed_work* work, uint32_t* lost_node) {
  hm_fixed_state* state = work->state;
  const int32_t before = largest_of(state->change, 3 * work->plan->cells);
  if (before == 0) return choose_by_pull(work, lost_node);
  state->scale_exponent =
      within(work->plan, state->change_exponent + 1 + power_above((uint64_t)before, (uint64_t)unit));
  return HM_OK;
}

/* a / 2^places, to nearest; any places. */
static int32_t rescaled(int32_t a, int32_t places) {
  if (places > 30) return 0;
  if (places > 0) return hm_rounded_down(a, (uint32_t)places);
  return (int32_t)((uint32_t)a << (places > -30 ? -places : 30));
}

/* V0: the change of acceleration of the step before. */
static void set_expansion_point(const hm_fixed_work* work) {
  hm_fixed_state* state = work->state;
  const int32_t places = state->scale_exponent - state->change_exponent;
  for (uint32_t k = 0; k < 3 * work->plan->cells; ++k) state->start[k] = rescaled(state->change[k], places);
}

/* The scale to relax at again; the one that is where that is good enough. */
static int32_t better_scale(const hm_fixed_work* work, uint32_t growths) {
  const hm_fixed_state* state = work->state;
  const int32_t scale = state->scale_exponent, largest = largest_of(state->output, 3 * work->plan->cells);
  if (largest > unit / 4 * 3)
    return scale < work->plan->most_scale && growths < most_growths ? scale + 1 : scale;
  if (largest >= unit / 8 || growths > 0) return scale;
  int32_t smaller = scale;
  if (largest > 0)
    smaller = scale + 1 + power_above((uint64_t)largest, (uint64_t)unit);
  else if (largest_bias(work) > 0)
    smaller = scale - 2;
  return smaller < scale && smaller >= work->plan->least_scale ? smaller : scale;
}

static int relax_in_range(const hm_fixed_work* work, hm_relaxation* sum, uint32_t* lost_node) {
  hm_fixed_state* state = work->state;
  for (uint32_t growths = 0;;) {
    TRY(hm_fixed_build(work, lost_node));
    TRY(hm_fixed_relax(work, sum));
    const int32_t better = better_scale(work, growths), scale = state->scale_exponent;
    if (better == scale) return HM_OK;
    growths += better > scale;
    for (uint32_t k = 0; k < 3 * work->plan->cells; ++k)
      state->start[k] = rescaled(state->output[k], better - scale);
    state->scale_exponent = better;
  }
}

static void find_next(const hm_fixed_work* work) {
  const hm_fixed_plan* plan = work->plan;
  const hm_fixed_state* state = work->state;
  const hm_fixed_reach reach = hm_fixed_reach_of(plan, state->scale_exponent);
  const uint32_t finer = (uint32_t)(plan->spring_places - plan->position_places);
  int32_t* next = state->next;
  for (uint32_t c = 0; c < plan->cells; ++c, next += 6)
    for (uint32_t p = 0, at = 3 * work->mesh->node[c].node; p < 3; ++p, ++at) {
      const int32_t moved = hm_fixed_reached(&reach, state->output[3 * c + p]);
      next[p] = state->predicted[at] + (finer > 0 ? hm_rounded_down(moved, finer) : moved);
      const int64_t way = (int64_t)(next[p] - state->position[at]) << HM_FIXED_FINER;
      next[3 + p] = (int32_t)(way * plan->kept >> 30);
    }
}

int hm_fixed_implicit(const hm_fixed_work* work, hm_relaxation* sum, uint32_t* lost_node) {
  hm_fixed_state* state = work->state;
  predict(work);
  TRY(choose_scale(work, lost_node));
  set_expansion_point(work);
  TRY(relax_in_range(work, sum, lost_node));
  find_next(work);
  TRY(hm_fixed_move(work, lost_node));
  for (uint32_t k = 0; k < 3 * work->plan->cells; ++k) state->change[k] = state->output[k];
  state->change_exponent = state->scale_exponent;
  return HM_OK;
}
