/* Raw codes from the bits of doubles: for processors without an FPU. */
#ifndef HOPMESH_FIRMWARE_QUANTISE_WHOLE_H
#define HOPMESH_FIRMWARE_QUANTISE_WHOLE_H

#include "firmware/quantise.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a library computes with doubles, whole numbers are several times faster; elsewhere slower. */
#ifdef __riscv_float_abi_soft
enum { HM_DOUBLES_ARE_SOFT = 1 };
#else
enum { HM_DOUBLES_ARE_SOFT = 0 };
#endif

/* A normal power of two above 0? */
int hm_is_power_of_two(double scale);

/* As hm_codes, bit for bit, of a scale that is a power of two. */
uint32_t hm_codes_of_bits(const double* values, uint32_t count, double scale, const hm_format* format,
                          uint32_t* words);

/* How many values are not 0 while their codes are. */
uint32_t hm_vanished_by_bits(const double* values, const uint32_t* codes, uint32_t count);

#ifdef __cplusplus
}
#endif

#endif
