/* From a double to a raw code: the firmware's own rounding and overflow, with SystemC's meaning
 * (docs/hardware/number-formats.md). */
#ifndef HOPMESH_FIRMWARE_QUANTISE_H
#define HOPMESH_FIRMWARE_QUANTISE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* fixed<W,I,Q,O>; the modes as firmware/registers.h numbers them. */
typedef struct hm_format {
  int width, integer_bits, rounding, overflow;
} hm_format;

int hm_fraction_bits(const hm_format* format);

/* Exact, for exponents of normal doubles. */
double hm_power_of_two(int exponent);

/* The least power of two that is at least x, and at least 2^-200; x where it is not finite. */
double hm_power_above(double x);

/* Raw code of a value already counted in the format's last places; sets *clipped if it did not fit, else
 * leaves it. */
int32_t hm_code(double counted, const hm_format* format, int* clipped);

/* Raw code of value * 2^shift. */
int32_t hm_quantise(double value, int shift, const hm_format* format, int* clipped);

/* Many values at once: words[k] becomes hm_code(values[k] * scale), scale positive; returns how many did not
 * fit. Bit for bit the same, in a fraction of the time where the format saturates. */
uint32_t hm_codes(const double* values, uint32_t count, double scale, const hm_format* format,
                  uint32_t* words);

/* The largest value that the format has. */
double hm_largest_value(const hm_format* format);

/* The largest shift for which `largest` * 2^shift still fits the format. */
int hm_room(double largest, const hm_format* format);

#ifdef __cplusplus
}
#endif

#endif
