/* What the firmware asks of doubles: C only. */
#ifndef HOPMESH_FIRMWARE_DOUBLES_H
#define HOPMESH_FIRMWARE_DOUBLES_H

#include <stdint.h>

double sqrt(double); /* IEEE: correctly rounded everywhere; the only function asked of the platform */

static inline double hm_magnitude(double x) {
  return x < 0 ? -x : x;
}

static inline int hm_is_finite(double x) {
  return x - x == 0;
}

static inline double hm_length(const double* v, uint32_t n) {
  double square = 0;
  for (uint32_t p = 0; p < n; ++p) square += v[p] * v[p];
  return sqrt(square);
}

#endif
