#include "firmware/quantise.h"

#include "firmware/doubles.h"
#include "firmware/quantise_whole.h"
#include "firmware/registers.h"

double hm_power_of_two(int exponent) {
  double value = 1;
  for (; exponent > 0; --exponent) value *= 2;
  for (; exponent < 0; ++exponent) value /= 2;
  return value;
}

double hm_power_above(double x) {
  const double least = 0x1p-200; /* the square of what it reaches still counts */
  double power = 1;
  if (!hm_is_finite(x)) return x;
  while (power < x) power *= 2;
  while (power / 2 >= x && power > least) power /= 2;
  return power;
}

static int64_t most(const hm_format* f) {
  return ((int64_t)1 << (f->width - 1)) - 1;
}

int hm_fraction_bits(const hm_format* f) {
  return f->width - f->integer_bits;
}

/* A rounding mode as a correction of "to nearest, ties to even": one more from a rest of `up` on, one less
   below a rest of `down`. The modes that do not tell plus from minus work on magnitudes. */
typedef struct rounding_rule {
  double up, down;
  int of_magnitude;
} rounding_rule;

static rounding_rule rule_of(int rounding) {
  const double never = 2, tie = -0x1.fffffffffffffp-2; /* below it there is only -0.5 */
  switch (rounding) {
  case HM_RND:
    return (rounding_rule){0.5, -never, 0};
  case HM_RND_ZERO:
    return (rounding_rule){never, tie, 1};
  case HM_RND_MIN_INF:
    return (rounding_rule){never, tie, 0};
  case HM_RND_INF:
    return (rounding_rule){0.5, -never, 1};
  case HM_TRN:
    return (rounding_rule){never, 0, 0};
  case HM_TRN_ZERO:
    return (rounding_rule){never, 0, 1};
  default:
    return (rounding_rule){never, -never, 0}; /* HM_RND_CONV */
  }
}

/* The door of all rounding: x to a whole number. Adding and taking away 2^52 + 2^51 rounds to nearest, ties
   to even; beyond 2^51 it loses the last places. No branch depends on a value: compilers do several at a
   time. */
static inline double rounded(double x, double up, double down, const int of_magnitude) {
  const double pushed = 6755399441055744.0; /* 2^52 + 2^51: doubles of this size are whole numbers */
  const double size = of_magnitude ? hm_magnitude(x) : x;
  const double nearest = (size + pushed) - pushed, rest = size - nearest;
  const double more = rest >= up ? 1.0 : 0.0, less = rest < down ? 1.0 : 0.0;
  const double whole = nearest + more - less;
  return of_magnitude && x < 0 ? -whole : whole;
}

static int64_t bring_into_range(int64_t code, const hm_format* f) {
  const int64_t high = most(f), low = f->overflow == HM_SAT_SYM ? -high : -high - 1;
  if (code >= low && code <= high) return code;
  if (f->overflow == HM_SAT_ZERO) return 0;
  if (f->overflow != HM_WRAP) return code > high ? high : low;
  const uint64_t sign = (uint64_t)1 << (f->width - 1), kept = (uint64_t)code & (2 * sign - 1);
  return (int64_t)(kept ^ sign) - (int64_t)sign;
}

int32_t hm_code(double x, const hm_format* format, int* clipped) {
  const double far = 4611686018427387904.0; /* 2^62: every format is full */
  const double block = 4294967296.0;        /* 2^32: the widest format; what lies beyond needs no rounding */
  const rounding_rule rule = rule_of(format->rounding);
  const int beyond = hm_magnitude(x) > far;
  if (beyond && format->overflow == HM_WRAP) /* only the low bits count; none are left beyond 2^85 */
    x = hm_magnitude(x) < far * 8388608.0 ? x - (double)(int64_t)(x / block) * block : 0;
  else if (beyond)
    x = x < 0 ? -far : far;
  const double blocks = (double)(int64_t)(x / block);
  const double low = rounded(x - blocks * block, rule.up, rule.down, rule.of_magnitude);
  const int64_t code = (int64_t)(blocks * block) + (int64_t)low, kept = bring_into_range(code, format);
  if (kept != code || beyond) *clipped = 1;
  return (int32_t)kept;
}

int32_t hm_quantise(double value, int shift, const hm_format* format, int* clipped) {
  return hm_code(value * hm_power_of_two(shift + hm_fraction_bits(format)), format, clipped);
}

/* ---- many values ---- */

static inline double limited(double x, double low, double high) {
  const double below = x > high ? high : x;
  return below < low ? low : below;
}

static inline void saturated_codes(const double* values, uint32_t count, double scale, rounding_rule rule,
                                   const int of_magnitude, double low, double high, uint32_t* words) {
  for (uint32_t k = 0; k < count; ++k) {
    const double code = rounded(values[k] * scale, rule.up, rule.down, of_magnitude);
    words[k] = (uint32_t)(int32_t)limited(code, low, high);
  }
}

/* Only a code at an end of the range can have been clipped; hm_code knows whether it was. */
static uint32_t count_clipped(const double* values, uint32_t count, double scale, const hm_format* format,
                              uint32_t low, uint32_t high, const uint32_t* words) {
  uint32_t at_an_end = 0, clipped = 0;
  for (uint32_t k = 0; k < count; ++k) at_an_end += (uint32_t)((words[k] == low) | (words[k] == high));
  for (uint32_t k = 0; k < count && at_an_end > 0; ++k) {
    if (words[k] != low && words[k] != high) continue;
    int beyond = 0;
    hm_code(values[k] * scale, format, &beyond);
    clipped += (uint32_t)beyond;
    --at_an_end;
  }
  return clipped;
}

static uint32_t exact_codes(const double* values, uint32_t count, double scale, const hm_format* format,
                            uint32_t* words) {
  uint32_t clipped = 0;
  for (uint32_t k = 0; k < count; ++k) {
    int beyond = 0;
    words[k] = (uint32_t)hm_code(values[k] * scale, format, &beyond);
    clipped += (uint32_t)beyond;
  }
  return clipped;
}

uint32_t hm_codes(const double* values, uint32_t count, double scale, const hm_format* format,
                  uint32_t* words) {
  if (HM_DOUBLES_ARE_SOFT && hm_is_power_of_two(scale))
    return hm_codes_of_bits(values, count, scale, format, words);
  if (format->overflow != HM_SAT && format->overflow != HM_SAT_SYM)
    return exact_codes(values, count, scale, format, words);
  const rounding_rule rule = rule_of(format->rounding);
  const int64_t high = most(format), low = format->overflow == HM_SAT_SYM ? -high : -high - 1;
  if (rule.of_magnitude)
    saturated_codes(values, count, scale, rule, 1, (double)low, (double)high, words);
  else
    saturated_codes(values, count, scale, rule, 0, (double)low, (double)high, words);
  return count_clipped(values, count, scale, format, (uint32_t)low, (uint32_t)high, words);
}

double hm_largest_value(const hm_format* f) {
  return (double)most(f) / hm_power_of_two(hm_fraction_bits(f));
}

int hm_room(double largest, const hm_format* f) {
  const double limit = hm_largest_value(f);
  int shift = 0;
  while (largest * 2 <= limit && shift < 960) largest *= 2, ++shift;
  while (largest > limit && shift > -1000) largest /= 2, --shift;
  return shift;
}
