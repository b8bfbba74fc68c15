/* What the steps of the incremental potential share (docs/method/theory.md, section 4): outputs are changes
   over a scale, a power of two chosen step by step so that they use their range without being clipped. */
#ifndef HOPMESH_FIRMWARE_INCREMENTAL_H
#define HOPMESH_FIRMWARE_INCREMENTAL_H

#include "firmware/formulation.h"

/* What acts on a coordinate of a free node beside its springs, as an acceleration. */
static inline double hm_force_on(const hm_step_parameters* parameters, uint32_t node, uint32_t axis) {
  return parameters->force[axis] + (parameters->node_force ? parameters->node_force[3 * node + axis] : 0.0);
}

/* The largest magnitude; what is no number counts as larger than any. */
double hm_largest(const double* values, uint32_t count);

/* The largest weight of a neuron to itself. */
double hm_largest_own(const hm_mesh* mesh, const hm_network* network);

void hm_clear_outputs(const hm_step_work* work);

/* What the largest pull does to the stiffest node, its own weight alone holding it: at least half of what is
   to come. Leaves a network at another scale behind. */
double hm_change_by_pull(const hm_step_work* work);

/* For a change of which half the range is expected to be used, as far as the work's most_scale allows. */
void hm_choose_scale(const hm_step_work* work, double expected_change);

/* hm_formulation.build of springs and inertia. */
void hm_build_incremental(const hm_step_work* work);

/* Expands until the largest output is within its bounds. */
int hm_relax_in_range(const hm_step_work* work);

/* Shall the scale double, with so large an output? */
int hm_may_grow(const hm_step_work* work, double largest);

/* hm_formulation.residual of springs and inertia. */
void hm_residual_of_increment(const hm_step_work* work, const double* V, double* residual);

#endif
