/* A network in whole numbers into the array's windows, and its outputs back: no floating point. */
#include "firmware/driver_parts.h"
#include "firmware/fixed/fixed_parts.h"
#include "firmware/registers.h"

/* How numbers become codes: what is added, by sign, before `down` places are cut off; to even adds one more
   to what becomes an odd code. */
typedef struct code_rule {
  uint32_t down;
  int32_t add[2], even, low, high;
  int overflow;
} code_rule;

static code_rule rule_of(const hm_format* f, uint32_t down) {
  const int32_t most = (int32_t)(((uint32_t)1 << down) - 1), half = down > 0 ? (int32_t)(1u << down >> 1) : 0;
  const int32_t below = half > 0 ? half - 1 : 0, high = (int32_t)(((uint32_t)1 << (f->width - 1)) - 1);
  code_rule rule = {down, {half, half}, 0, f->overflow == HM_SAT_SYM ? -high : -high - 1, high, f->overflow};
  switch (f->rounding) {
  case HM_RND_ZERO:
    rule.add[0] = below;
    break;
  case HM_RND_MIN_INF:
    rule.add[0] = rule.add[1] = below;
    break;
  case HM_RND_INF:
    rule.add[1] = below;
    break;
  case HM_RND_CONV:
    rule.add[0] = rule.add[1] = below, rule.even = half > 0;
    break;
  case HM_TRN:
    rule.add[0] = rule.add[1] = 0;
    break;
  case HM_TRN_ZERO:
    rule.add[0] = 0, rule.add[1] = most;
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

/* Of a number that the largest code is no smaller than, once `down` places are gone. */
static inline int32_t code_of(int32_t w, const code_rule* rule) {
  const int32_t even = rule->even & (w >> rule->down);
  return (w + rule->add[w < 0] + even) >> rule->down;
}

/* As code_rule, of numbers of 64 bits. */
typedef struct wide_rule {
  uint32_t down;
  int64_t add[2];
  int32_t even;
} wide_rule;

static wide_rule wide_rule_of(const hm_format* f, uint32_t down) {
  const code_rule by = rule_of(f, down < 30 ? down : 30);
  wide_rule rule = {down, {by.add[0], by.add[1]}, by.even};
  if (down <= 30) return rule;
  for (uint32_t k = 0; k < 2; ++k) { /* a half, one less, all or nothing, of more places */
    const int64_t less = by.add[k] & 1, whole = (int64_t)(by.add[k] + less) << (down - 30);
    rule.add[k] = whole - less;
  }
  return rule;
}

static inline int64_t wide_code_of(int64_t w, const wide_rule* rule) {
  const int64_t even = rule->even & hm_shifted(w, rule->down);
  return hm_shifted(w + rule->add[w < 0] + even, rule->down);
}

/* w * 2^-down as a number of 64 bits and the places that are still to be cut, at most 61. Far beyond every
   format it is held; far behind it, what is lost is one bit. */
static int64_t brought_near(int64_t w, int32_t* down) {
  const int64_t far = INT64_C(1) << 40;
  for (; *down < 0 && w < far && w > -far; ++*down) w *= 2;
  if (*down < 0) *down = 0;
  if (*down <= 61) return w;
  const uint32_t away = *down - 61 < 63 ? (uint32_t)(*down - 61) : 63;
  const int64_t less = hm_shifted(w, away);
  *down = 61;
  return less | (w != (int64_t)((uint64_t)less << away));
}

/* Of any number and any place of its point. */
static int32_t code_of_any(int64_t w, int32_t down, const hm_format* format, uint32_t* clipped) {
  const int64_t near = brought_near(w, &down);
  const wide_rule wide = wide_rule_of(format, (uint32_t)down);
  const code_rule range = rule_of(format, 0);
  const int64_t code = wide_code_of(near, &wide);
  return code > range.high || code < range.low ? beyond(code, &range, clipped) : (int32_t)code;
}

/* ---- the exponent of a step */

/* Four in turn. */
static uint32_t largest_weight(const hm_fixed_work* work) {
  const int32_t *w = work->state->weight, *const end = w + work->plan->weights;
  int32_t most = 0, least = 0;
  for (; end - w >= 4; w += 4) {
    const int32_t a = w[0], b = w[1], c = w[2], d = w[3];
    if (a > most) most = a;
    if (a < least) least = a;
    if (b > most) most = b;
    if (b < least) least = b;
    if (c > most) most = c;
    if (c < least) least = c;
    if (d > most) most = d;
    if (d < least) least = d;
  }
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

/* Numbers that fit, as choose_shift has seen to: a short loop, for there are many. */
static uint32_t fitting_codes(const int32_t* w, uint32_t count, const code_rule* rule, uint32_t* codes) {
  const code_rule by = *rule;
  uint32_t vanished = 0;
  if (by.add[0] == by.add[1] && !by.even) {
    for (const int32_t* const end = w + count; w != end; ++w, ++codes) {
      const int32_t number = *w, code = (number + by.add[0]) >> by.down;
      *codes = (uint32_t)code;
      if (code == 0) vanished += number != 0;
    }
    return vanished;
  }
  for (uint32_t k = 0; k < count; ++k) {
    const int32_t code = code_of(w[k], &by);
    codes[k] = (uint32_t)code;
    vanished += code == 0 && w[k] != 0;
  }
  return vanished;
}

static uint32_t any_codes(hm_driver* d, const int32_t* w, uint32_t count, const hm_format* format,
                          int32_t down, uint32_t* codes) {
  uint32_t vanished = 0;
  for (uint32_t k = 0; k < count; ++k) {
    codes[k] = (uint32_t)code_of_any(w[k], down, format, &d->clipped);
    vanished += codes[k] == 0 && w[k] != 0;
  }
  return vanished;
}

/* A number and what is added to it fit a word. */
enum { MOST_DOWN = 30 };

static int put_weights(hm_driver* d, const hm_fixed_work* work, int32_t down) {
  hm_stream stream = hm_stream_of_codes(&d->line, &d->weights);
  const int32_t* w = work->state->weight;
  for (uint32_t left = work->plan->weights; left > 0;) {
    uint32_t room;
    uint32_t* const at = hm_stream_room(&stream, &room);
    const uint32_t part = left < room ? left : room;
    if (down >= 0 && down < MOST_DOWN) {
      const code_rule rule = rule_of(&d->weight, (uint32_t)down);
      d->vanished += fitting_codes(w, part, &rule, at);
    } else {
      d->vanished += any_codes(d, w, part, &d->weight, down, at);
    }
    TRY(hm_stream_take(&stream, part));
    w += part;
    left -= part;
  }
  return hm_stream_end(&stream);
}

static int put_biases(hm_driver* d, const hm_fixed_work* work, int32_t down) {
  hm_stream stream = hm_stream_of_codes(&d->line, &d->biases);
  const int plain = down >= 0 && down < 62;
  const wide_rule rule = wide_rule_of(&d->bias, plain ? (uint32_t)down : 0);
  for (uint32_t k = 0; k < 3 * work->plan->cells; ++k) {
    uint32_t room;
    uint32_t* const at = hm_stream_room(&stream, &room);
    const int64_t bias = work->state->bias[k];
    const int32_t code =
        plain ? (int32_t)wide_code_of(bias, &rule) : code_of_any(bias, down, &d->bias, &d->clipped);
    d->vanished += bias != 0 && code == 0;
    *at = (uint32_t)code;
    TRY(hm_stream_take(&stream, 1));
  }
  return hm_stream_end(&stream);
}

/* The range is looked at; an output that clips or vanishes is none of the network's. */
static int put_outputs(hm_driver* d, const hm_fixed_work* work) {
  hm_stream stream = hm_stream_of_codes(&d->line, &d->outputs);
  const code_rule rule = rule_of(&d->state, (uint32_t)(HM_FIXED_OUTPUT - hm_fraction_bits(&d->state)));
  for (uint32_t k = 0; k < 3 * work->plan->cells; ++k) {
    uint32_t room, clipped = 0;
    uint32_t* const at = hm_stream_room(&stream, &room);
    const int32_t code = code_of(work->state->start[k], &rule);
    *at = (uint32_t)(code > rule.high || code < rule.low ? beyond(code, &rule, &clipped) : code);
    TRY(hm_stream_take(&stream, 1));
  }
  return hm_stream_end(&stream);
}

static int load(const hm_fixed_work* work) {
  hm_driver* d = work->driver;
  int32_t weight_down, bias_down;
  d->clipped = d->vanished = 0;
  d->shift = choose_shift(work, &weight_down, &bias_down);
  TRY(hm_driver_expect_idle(d));
  TRY(put_weights(d, work, weight_down));
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
