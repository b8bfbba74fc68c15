#include "firmware/quantise.h"

#include "firmware/registers.h"

double hm_power_of_two(int exponent) {
  double value = 1;
  for (; exponent > 0; --exponent) value *= 2;
  for (; exponent < 0; ++exponent) value /= 2;
  return value;
}

static double magnitude(double x) {
  return x < 0 ? -x : x;
}

static int64_t most(const hm_format* f) {
  return ((int64_t)1 << (f->width - 1)) - 1;
}

int hm_fraction_bits(const hm_format* f) {
  return f->width - f->integer_bits;
}

/* Is 1 to be added to `whole`, the magnitude's whole part, where `rest` in [0, 1) is left? Magnitudes,
   because |x| - whole is exact, while x - floor(x) is not for a small negative x. */
static int rounds_away(int64_t whole, double rest, int negative, int rounding) {
  if (rest == 0 || rounding == HM_TRN_ZERO) return 0;
  if (rounding == HM_TRN) return negative;
  if (rest != 0.5) return rest > 0.5;
  switch (rounding) { /* a tie */
  case HM_RND:
    return !negative;
  case HM_RND_MIN_INF:
    return negative;
  case HM_RND_INF:
    return 1;
  case HM_RND_CONV:
    return (int)(whole & 1);
  default:
    return 0; /* HM_RND_ZERO */
  }
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
  const double block = 4294967296.0;        /* 2^32: the widest format */
  const int negative = (x < 0), beyond = (magnitude(x) > far);
  double size = magnitude(x);
  if (beyond && format->overflow == HM_WRAP) /* only the low bits count; none are left beyond 2^85 */
    size = size < far * 8388608.0 ? size - (double)(int64_t)(size / block) * block : 0;
  else if (beyond)
    size = far;
  const int64_t whole = (int64_t)size;
  const int64_t away = whole + rounds_away(whole, size - (double)whole, negative, format->rounding);
  const int64_t code = negative ? -away : away, kept = bring_into_range(code, format);
  if (kept != code || beyond) *clipped = 1;
  return (int32_t)kept;
}

int32_t hm_quantise(double value, int shift, const hm_format* format, int* clipped) {
  return hm_code(value * hm_power_of_two(shift + hm_fraction_bits(format)), format, clipped);
}

int hm_room(double largest, const hm_format* f) {
  const double limit = (double)most(f) / hm_power_of_two(hm_fraction_bits(f));
  int shift = 0;
  while (largest * 2 <= limit && shift < 960) largest *= 2, ++shift;
  while (largest > limit && shift > -1000) largest /= 2, --shift;
  return shift;
}
