/* A network in whole numbers into the array's windows, and its outputs back: no floating point. */
#include "firmware/driver_parts.h"
#include "firmware/fixed/fixed_parts.h"
#include "firmware/registers.h"

/* How numbers become codes: places cut off (below 0: put behind), and above which rest, by sign, a code is
   one more; to even makes the bound one less for odd codes. */
typedef struct code_rule {
  int32_t down;
  uint32_t above[2], even, mask;
  int32_t low, high;
  int overflow;
} code_rule;

static code_rule rule_of(const hm_format* f, int32_t down) {
  const uint32_t places = down > 0 && down < 32 ? (uint32_t)down : 0;
  const uint32_t mask = places > 0 ? UINT32_MAX >> (32 - places) : 0,
                 half = places > 0 ? 1u << (places - 1) : 0;
  const uint32_t nearest = half, up = half > 0 ? half - 1 : 0;
  const int32_t high = (int32_t)(((uint32_t)1 << (f->width - 1)) - 1);
  code_rule rule = {down, {up, up},   0, mask, f->overflow == HM_SAT_SYM ? -high : -high - 1,
                    high, f->overflow};
  switch (f->rounding) { /* of what is cut from a code rounded down */
  case HM_RND_ZERO:
    rule.above[0] = nearest;
    break;
  case HM_RND_MIN_INF:
    rule.above[0] = rule.above[1] = nearest;
    break;
  case HM_RND_INF:
    rule.above[1] = nearest;
    break;
  case HM_RND_CONV:
    rule.above[0] = rule.above[1] = nearest, rule.even = half > 0;
    break;
  case HM_TRN:
    rule.above[0] = rule.above[1] = mask;
    break;
  case HM_TRN_ZERO:
    rule.above[0] = mask, rule.above[1] = 0;
    break;
  default:
    break; /* HM_RND */
  }
  return rule;
}

static int32_t beyond(int64_t code, const code_rule* rule, uint32_t* clipped) {
  *clipped += 1;
  if (rule->overflow == HM_SAT_ZERO) return 0;
  if (rule->overflow != HM_WRAP) return code > rule->high ? rule->high : rule->low;
  const uint32_t sign = (uint32_t)rule->high + 1, kept = (uint32_t)code & (2 * sign - 1);
  return (int32_t)((kept ^ sign) - sign);
}

static inline int32_t code_of(int32_t w, const code_rule* rule, uint32_t* clipped) {
  const int32_t whole = w >> rule->down;
  const uint32_t rest = (uint32_t)w & rule->mask;
  const int32_t code = whole + (rest > rule->above[w < 0] - (rule->even & (uint32_t)whole));
  return code > rule->high || code < rule->low ? beyond(code, rule, clipped) : code;
}

/* Of a number that is no word, or a code that is finer than it. More than 31 places lost leave 31 of the
   rest, the last of which stands for all that follow. */
static int32_t code_of_wide(int64_t w, const code_rule* rule, const hm_format* format, uint32_t* clipped) {
  int64_t kept = w;
  int32_t down = rule->down;
  if (down < 0) {
    const int64_t most = INT64_MAX >> 1;
    for (; down < 0 && kept <= most / 2 && kept >= -most / 2; ++down) kept *= 2;
    down = 0;
  }
  if (down > 31) {
    const int64_t less = hm_shifted(w, (uint32_t)(down - 31 < 63 ? down - 31 : 63));
    kept = less | (hm_shifted(w, 0) != (int64_t)((uint64_t)less << (down - 31 < 63 ? down - 31 : 63)));
    down = 31;
  }
  const code_rule at = rule_of(format, down);
  const int64_t whole = hm_shifted(kept, (uint32_t)down);
  const uint32_t rest = (uint32_t)kept & at.mask;
  const int64_t code = whole + (rest > at.above[w < 0] - (at.even & (uint32_t)whole));
  return code > at.high || code < at.low ? beyond(code, &at, clipped) : (int32_t)code;
}

/* ---- the exponent of a step */

static uint32_t largest_weight(const hm_fixed_work* work) {
  const int32_t *w = work->state->weight, *const end = w + work->plan->weights;
  int32_t most = 0, least = 0;
  for (; w != end; ++w) {
    if (*w > most) most = *w;
    if (*w < least) least = *w;
  }
  return (uint32_t)most > (uint32_t)-least ? (uint32_t)most : (uint32_t)-least;
}

static uint64_t largest_bias(const hm_fixed_work* work) {
  const int64_t *b = work->state->bias, *const end = b + 3 * work->plan->cells;
  int64_t largest = 0;
  for (; b != end; ++b) {
    const int64_t size = *b < 0 ? -*b : *b;
    if (size > largest) largest = size;
  }
  return (uint64_t)largest;
}

/* The least number of places to cut so that it fits. */
static int32_t places_for(uint64_t largest, const hm_format* f) {
  const uint64_t most = ((uint64_t)1 << (f->width - 1)) - 1;
  int32_t down = 0;
  while (largest > (most << (down > 0 ? down : 0)) && down < 31) ++down;
  while (largest >> (down > 0 ? down : 0) > most) ++down;
  while (down <= 0 && down > -32 && largest << (1 - down) <= most) --down;
  return down;
}

/* As hm_driver_relax: the largest shift at which both fit. Leaves the places to cut of each. */
static int choose_shift(const hm_fixed_work* work, int32_t* weight_down, int32_t* bias_down) {
  const hm_driver* d = work->driver;
  const hm_fixed_state* state = work->state;
  const int32_t unit = work->plan->unit_exponent + 2 * state->scale_exponent;
  const int32_t of_weight = HM_FIXED_WEIGHT - unit - hm_fraction_bits(&d->weight);
  const int32_t of_bias = state->bias_places - unit - hm_fraction_bits(&d->bias);
  const uint32_t w = largest_weight(work);
  const uint64_t b = largest_bias(work);
  int32_t shift = of_weight - places_for(w, &d->weight);
  const int32_t for_bias = of_bias - places_for(b, &d->bias);
  if (w == 0 && b == 0) shift = 0;
  if (b != 0 && (w == 0 || for_bias < shift)) shift = for_bias;
  *weight_down = of_weight - shift;
  *bias_down = of_bias - shift;
  return shift;
}

/* ---- into the windows */

static int put(hm_driver* d, hm_stream* stream, const int32_t* w, uint32_t count, const hm_format* format,
               int32_t down) {
  const code_rule rule = rule_of(format, down);
  const int plain = down >= 0 && down < 32;
  while (count > 0) {
    uint32_t room;
    uint32_t* const at = hm_stream_room(stream, &room);
    const uint32_t part = count < room ? count : room;
    for (uint32_t k = 0; k < part; ++k) {
      const int32_t code =
          plain ? code_of(w[k], &rule, &d->clipped) : code_of_wide(w[k], &rule, format, &d->clipped);
      if (code == 0) d->vanished += w[k] != 0;
      at[k] = (uint32_t)code;
    }
    TRY(hm_stream_take(stream, part));
    w += part;
    count -= part;
  }
  return hm_stream_end(stream);
}

static int put_biases(hm_driver* d, const hm_fixed_work* work, int32_t down) {
  hm_stream stream = hm_stream_of_codes(&d->line, &d->biases);
  const code_rule rule = rule_of(&d->bias, down);
  for (uint32_t k = 0; k < 3 * work->plan->cells; ++k) {
    uint32_t room;
    uint32_t* const at = hm_stream_room(&stream, &room);
    const int64_t bias = work->state->bias[k];
    const int32_t code = code_of_wide(bias, &rule, &d->bias, &d->clipped);
    d->vanished += bias != 0 && code == 0;
    *at = (uint32_t)code;
    TRY(hm_stream_take(&stream, 1));
  }
  return hm_stream_end(&stream);
}

/* An output never counts as clipped or vanished. */
static int put_outputs(hm_driver* d, const hm_fixed_work* work) {
  hm_stream stream = hm_stream_of_codes(&d->line, &d->outputs);
  const uint32_t clipped = d->clipped, vanished = d->vanished;
  TRY(put(d, &stream, work->state->start, 3 * work->plan->cells, &d->state,
          HM_FIXED_OUTPUT - hm_fraction_bits(&d->state)));
  d->clipped = clipped, d->vanished = vanished;
  return HM_OK;
}

static int load(const hm_fixed_work* work) {
  hm_driver* d = work->driver;
  int32_t weight_down, bias_down;
  d->clipped = d->vanished = 0;
  d->shift = choose_shift(work, &weight_down, &bias_down);
  TRY(hm_driver_expect_idle(d));
  hm_stream weights = hm_stream_of_codes(&d->line, &d->weights);
  TRY(put(d, &weights, work->state->weight, work->plan->weights, &d->weight, weight_down));
  TRY(put_biases(d, work, bias_down));
  return put_outputs(d, work);
}

int hm_fixed_relax(const hm_fixed_work* work, hm_relaxation* sum) {
  hm_driver* d = work->driver;
  hm_fixed_state* state = work->state;
  const uint32_t outputs = 3 * work->plan->cells;
  const int up = HM_FIXED_OUTPUT - hm_fraction_bits(&d->state);
  hm_relaxation one;
  TRY(load(work));
  TRY(hm_driver_start(d, work->plan->threshold, work->plan->max_sweeps));
  TRY(hm_driver_read_counters(d, &one));
  TRY(hm_window_read_codes(&d->line, &d->outputs, state->output, outputs));
  for (uint32_t k = 0; k < outputs; ++k) state->output[k] = (int32_t)((uint32_t)state->output[k] << up);
  hm_add_relaxation(sum, &one);
  if (work->heard) work->heard(work->listener, &one);
  return HM_OK;
}
