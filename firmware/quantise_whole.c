/* Raw codes from the doubles' own bits, by whole numbers of 32 bits alone: the same codes as hm_code's, on a
   processor for which every operation on doubles is a library's. */
#include "firmware/quantise_whole.h"
#include "firmware/doubles.h"
#include "firmware/registers.h"

typedef union double_words { /* C11, 6.5.2.3: both read the same bytes */
  double value;
  uint64_t bits;
} double_words;

/* What lies behind the point, its first 32 bits, the last of which also stands for all that follow: a code is
   rounded away from zero where that is above a bound, by sign; to even makes the bound one less for odd
   codes. Codes have a largest magnitude, by sign. */
typedef struct whole_rule {
  uint32_t above[2], most[2], even;
} whole_rule;

static const uint32_t half = 0x80000000u, never = 0xFFFFFFFFu;

static whole_rule rule_of(const hm_format* f) {
  const uint32_t most = ((uint32_t)1 << (f->width - 1)) - 1;
  whole_rule rule = {{half, half}, {most, f->overflow == HM_SAT_SYM ? most : most + 1}, 0};
  switch (f->rounding) {
  case HM_RND:
    rule.above[0] = half - 1;
    break;
  case HM_RND_MIN_INF:
    rule.above[1] = half - 1;
    break;
  case HM_RND_INF:
    rule.above[0] = rule.above[1] = half - 1;
    break;
  case HM_TRN:
    rule.above[0] = never, rule.above[1] = 0;
    break;
  case HM_TRN_ZERO:
    rule.above[0] = rule.above[1] = never;
    break;
  case HM_RND_ZERO:
    break;
  default:
    rule.even = 1; /* HM_RND_CONV */
  }
  return rule;
}

/* A finite value that is no subnormal, of 53 bits `high` and `low`, `places` of them behind the point, at
   least 22. The magnitude of its code before the range is looked at. */
static inline uint32_t magnitude(uint32_t high, uint32_t low, uint32_t places, uint32_t negative,
                                 const whole_rule* rule) {
  uint32_t whole = 0, behind = 1;
  if (places > 53) {
    /* less than a half, but not nothing */
  } else if (places > 32) {
    const uint32_t down = places - 32, up = 32 - down;
    whole = high >> down;
    behind = high << up | low >> down | (low << up != 0);
  } else if (places == 32) {
    whole = high, behind = low;
  } else {
    whole = high << (32 - places) | low >> places;
    behind = low << (32 - places);
  }
  return whole + (behind > rule->above[negative] - (rule->even & whole));
}

/* What the quick way leaves over: nothing, subnormals, what is far too large, and overflow that is not held
   at an end. */
static uint32_t by_hm_code(double value, double scale, const hm_format* format, uint32_t* clipped) {
  int beyond = 0;
  const uint32_t code = (uint32_t)hm_code(value * scale, format, &beyond);
  *clipped += (uint32_t)beyond;
  return code;
}

static inline uint32_t code_of(double value, int shift, double scale, const whole_rule* rule,
                               const hm_format* format, uint32_t* clipped) {
  const uint64_t bits = (double_words){.value = value}.bits;
  const uint32_t top = (uint32_t)(bits >> 32), low = (uint32_t)bits, negative = top >> 31;
  const int exponent = (int)(top >> 20 & 0x7FF), places = 1075 - exponent - shift;
  if ((top << 1 | low) == 0) return 0;
  if (exponent == 0 || exponent + shift < 1 || places < 22) return by_hm_code(value, scale, format, clipped);
  const uint32_t high = (top & 0xFFFFF) | 0x100000;
  uint32_t size = magnitude(high, low, (uint32_t)places, negative, rule);
  if (size > rule->most[negative]) {
    if (format->overflow != HM_SAT && format->overflow != HM_SAT_SYM)
      return by_hm_code(value, scale, format, clipped);
    size = rule->most[negative];
    *clipped += 1;
  }
  return negative ? 0 - size : size;
}

int hm_is_power_of_two(double scale) {
  const uint64_t bits = (double_words){.value = scale}.bits, exponent = bits >> 52;
  return bits << 12 == 0 && exponent > 0 && exponent < 0x7FF;
}

uint32_t hm_codes_of_bits(const double* values, uint32_t count, double scale, const hm_format* format,
                          uint32_t* words) {
  const whole_rule rule = rule_of(format);
  const int shift = (int)((double_words){.value = scale}.bits >> 52) - 1023;
  uint32_t clipped = 0;
  for (uint32_t k = 0; k < count; ++k) words[k] = code_of(values[k], shift, scale, &rule, format, &clipped);
  return clipped;
}

uint32_t hm_vanished_by_bits(const double* values, const uint32_t* codes, uint32_t count) {
  uint32_t vanished = 0;
  for (uint32_t k = 0; k < count; ++k)
    vanished += (uint32_t)(codes[k] == 0 && (double_words){.value = values[k]}.bits << 1 != 0);
  return vanished;
}
