/* What the units of a step in whole numbers do for each other. C only. */
#ifndef HOPMESH_FIRMWARE_FIXED_PARTS_H
#define HOPMESH_FIRMWARE_FIXED_PARTS_H

#include "firmware/fixed/fixed.h"
#include "firmware/fixed/fixed_numbers.h"
#include "firmware/try.h"

/* What a node that is nowhere is told by: it comes from a spring that is too long. */
static inline int hm_fixed_lost(uint32_t node, uint32_t* lost_node) {
  *lost_node = node;
  return HM_ERROR_LOST;
}

/* Weights and biases of state->start about state->predicted, at the state's scale. HM_OK or HM_ERROR_LOST. */
int hm_fixed_build(const hm_fixed_work* work, uint32_t* lost_node);

/* Loads, runs and reads back: state->output. As hm_driver_relax answers. */
int hm_fixed_relax(const hm_fixed_work* work, hm_relaxation* sum);

/* reach of the state's scale, h * 2^scale, times an output, in places of a spring. */
typedef struct hm_fixed_reach {
  int32_t mantissa;
  uint32_t down; /* from the upper word of the product on: from 1 to 31 */
} hm_fixed_reach;
hm_fixed_reach hm_fixed_reach_of(const hm_fixed_plan* plan, int32_t scale_exponent);
static inline int32_t hm_fixed_reached(const hm_fixed_reach* reach, int32_t output) {
  return hm_rounded_down(hm_upper(output, reach->mantissa), reach->down);
}

int hm_fixed_probe(const hm_fixed_work* work, hm_relaxation* sum, uint32_t* lost_node);
int hm_fixed_implicit(const hm_fixed_work* work, hm_relaxation* sum, uint32_t* lost_node);

/* Keeps state->next as positions and ways, all of them or none. */
int hm_fixed_move(const hm_fixed_work* work, uint32_t* lost_node);

#endif
