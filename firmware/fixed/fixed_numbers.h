/* Whole numbers as fractions: products, shifts and the reciprocal root, without floating point. Q30 is a
   number counted in 2^-30. C only. */
#ifndef HOPMESH_FIRMWARE_FIXED_NUMBERS_H
#define HOPMESH_FIRMWARE_FIXED_NUMBERS_H

#include <stdint.h>

/* The upper word of a product, rounded down. */
static inline int32_t hm_upper(int32_t a, int32_t b) {
  return (int32_t)((int64_t)a * b >> 32);
}

static inline uint32_t hm_upper_of(uint32_t a, uint32_t b) {
  return (uint32_t)((uint64_t)a * b >> 32);
}

/* a / 2^places, to nearest; places from 1 to 31. */
static inline int32_t hm_rounded_down(int32_t a, uint32_t places) {
  return ((a >> (places - 1)) + 1) >> 1;
}

/* a / 2^places, rounded down; places from 0 to 63. Word by word: a compiler for 32 bits calls a library. */
static inline int64_t hm_shifted(int64_t a, uint32_t places) {
  const int32_t high = (int32_t)(a >> 32);
  const uint32_t low = (uint32_t)a;
  if (places == 0) return a;
  if (places < 32)
    return (int64_t)((uint64_t)(uint32_t)(high >> places) << 32 |
                     (low >> places | (uint32_t)high << (32 - places)));
  return (int64_t)(high >> (places - 32));
}

static inline int32_t hm_magnitude_of(int32_t a) {
  return a < 0 ? -a : a;
}

/* A square, below 2^62 and not 0: mantissa * 2^(32 - 2 half) of it, mantissa from 2^30 on, and 1 / root of
   mantissa / 2^32 in Q30, which is never above the true one; half from 1 to 31. */
typedef struct hm_root {
  uint32_t mantissa, inverse, half;
} hm_root;

/* 1 / sqrt((k + 1/2) / 256) in Q15, from k = 64 on: within 2^-8. */
extern const uint16_t hm_first_inverse[192];

/* Newton's step for y = 1 / sqrt(x): y (3 - x y^2) / 2. */
static inline uint32_t hm_better_inverse(uint32_t x, uint32_t y) {
  const uint32_t square = (uint32_t)((uint64_t)y * y >> 30); /* y < 2 */
  const uint32_t left = 0xC0000000u - hm_upper_of(x, square);
  return (uint32_t)((uint64_t)y * left >> 31);
}

static inline hm_root hm_root_of(uint64_t square) {
  const uint32_t high = (uint32_t)(square >> 32), low = (uint32_t)square;
  const uint32_t zeros = (uint32_t)(high != 0 ? __builtin_clz(high) : 32 + __builtin_clz(low)) & ~UINT32_C(1);
  const uint32_t x = zeros == 0   ? high
                     : zeros < 32 ? high << zeros | low >> (32 - zeros)
                                  : low << (zeros - 32);
  const uint32_t y = (uint32_t)hm_first_inverse[(x >> 24) - 64] << 15;
  return (hm_root){x, hm_better_inverse(x, hm_better_inverse(x, y)), zeros / 2};
}

/* The root itself, to nearest. */
static inline uint32_t hm_length_of(const hm_root* root) {
  const uint32_t whole = (uint32_t)((uint64_t)root->mantissa * root->inverse >> 30);
  return ((whole >> (root->half - 1)) + 1) >> 1;
}

/* A component over the length, Q29: at most 1 in size. */
static inline int32_t hm_along(const hm_root* root, int32_t component) {
  return hm_upper(component << (root->half - 1), (int32_t)(root->inverse - 4));
}

static inline uint64_t hm_square_of(const int32_t v[3]) {
  return (uint64_t)((int64_t)v[0] * v[0]) + (uint64_t)((int64_t)v[1] * v[1]) +
         (uint64_t)((int64_t)v[2] * v[2]);
}

#endif
