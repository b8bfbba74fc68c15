/* Whole numbers as fractions: products, shifts and the reciprocal root, without floating point. Q30 is a
   number counted in 2^-30. C only. */
#ifndef HOPMESH_FIRMWARE_FIXED_NUMBERS_H
#define HOPMESH_FIRMWARE_FIXED_NUMBERS_H

#include <stdint.h>

/* The upper word of a product, rounded down. On a RISC-V core said by its name: compilers make a product of
   64 by 64 bits of it wherever they have seen a sign. */
static inline int32_t hm_upper(int32_t a, int32_t b) {
#ifdef __riscv
  int32_t upper;
  __asm__("mulh %0, %1, %2" : "=r"(upper) : "r"(a), "r"(b));
  return upper;
#else
  return (int32_t)((int64_t)a * b >> 32);
#endif
}

/* All of it. */
static inline int64_t hm_product(int32_t a, int32_t b) {
  return (int64_t)((uint64_t)(uint32_t)hm_upper(a, b) << 32 | (uint32_t)a * (uint32_t)b);
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

/* Some 32 bits of a * b, from `places` on, where no more are there; places from 1 to 63. */
static inline uint32_t hm_product_from(uint32_t a, uint32_t b, uint32_t places) {
  const uint32_t high = hm_upper_of(a, b), low = a * b;
  return places < 32 ? low >> places | high << 1 << (31 - places) : high >> (places - 32);
}

static inline int32_t hm_magnitude_of(int32_t a) {
  return a < 0 ? -a : a;
}

/* A square, below 2^62 and not 0: mantissa * 2^(32 - 2 half) of it, mantissa from 2^30 on, and 1 / root of
   mantissa / 2^32 in Q30, within 2^-27 and below the true one; half from 1 to 31. */
typedef struct hm_root {
  uint32_t mantissa, inverse, half;
} hm_root;

/* 1 / sqrt((k + 1/2) / 256) in Q15, from k = 64 on: within 2^-8. */
extern const uint16_t hm_first_inverse[192];

/* Zeros in front of a number that is not 0, one less if they are odd. */
static inline uint32_t hm_even_zeros(uint32_t x) {
  uint32_t zeros = 0;
  if (x < UINT32_C(1) << 16) zeros = 16, x <<= 16;
  if (x < UINT32_C(1) << 24) zeros += 8, x <<= 8;
  if (x < UINT32_C(1) << 28) zeros += 4, x <<= 4;
  return x < UINT32_C(1) << 30 ? zeros + 2 : zeros;
}

/* Newton's step for y = 1 / sqrt(x), twice: y (3 - x y^2) / 2. Roundings may leave it a few last places
   above, which are taken away. */
static inline uint32_t hm_inverse_root(uint32_t x) {
  const uint32_t three = 0xC0000000u, first = hm_first_inverse[(x >> 24) - 64];
  const uint32_t better = hm_upper_of(first << 16, three - hm_upper_of(x, first * first)) << 1; /* Q31 */
  return hm_upper_of(better, three - hm_upper_of(x, hm_upper_of(better, better))) - 4;
}

static inline hm_root hm_root_of(uint64_t square) {
  const uint32_t high = (uint32_t)(square >> 32), low = (uint32_t)square;
  uint32_t zeros, x;
  if (high != 0) {
    zeros = hm_even_zeros(high);
    x = high << zeros | low >> 1 >> (31 - zeros);
  } else {
    zeros = hm_even_zeros(low);
    x = low << zeros;
    zeros += 32;
  }
  return (hm_root){x, hm_inverse_root(x), zeros / 2};
}

/* The root itself, to nearest. */
static inline uint32_t hm_length_of(const hm_root* root) {
  const uint32_t whole = hm_upper_of(root->mantissa, root->inverse << 1); /* Q31 */
  return (whole + ((UINT32_C(1) << root->half) >> 2)) >> (root->half - 1);
}

/* A component over the length, Q29: at most 1 in size. */
static inline int32_t hm_along(const hm_root* root, int32_t component) {
  return hm_upper((int32_t)((uint32_t)component << (root->half - 1)), (int32_t)root->inverse);
}

/* Three components, each by its name: compilers keep them in registers. */
typedef struct hm_triple {
  int32_t x, y, z;
} hm_triple;

static inline hm_triple hm_triple_at(const int32_t* v) {
  return (hm_triple){v[0], v[1], v[2]};
}

static inline uint64_t hm_square_of(hm_triple v) {
  return (uint64_t)hm_product(v.x, v.x) + (uint64_t)hm_product(v.y, v.y) + (uint64_t)hm_product(v.z, v.z);
}

#endif
