/* Answers that are more exact than the array's words (docs/method/theory.md, section 9): the host takes the
   residual in double, the array answers to it as a bias beside the weights that it has, and the host adds. */
#ifndef HOPMESH_FIRMWARE_REFINE_H
#define HOPMESH_FIRMWARE_REFINE_H

#include "firmware/formulation.h"

/* hm_formulation.relax of formulations that have a residual: hm_relax_in_range and then corrections, or
   corrections alone where weights of an earlier step may stay. */
int hm_relax_refined(const hm_step_work* work);

#endif
