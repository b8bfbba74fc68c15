/* Relaxing a network: who does it, and what it takes. */
#ifndef HOPMESH_FIRMWARE_RELAX_H
#define HOPMESH_FIRMWARE_RELAX_H

#include "firmware/network.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hm_relaxation {
  uint32_t sweeps, converged;
  uint64_t cycles;
} hm_relaxation;

/* Whoever relaxes a network: the driver with an array behind it, or anything that answers the same way. */
typedef struct hm_solver {
  void* context;
  int (*relax)(void* context, const hm_mesh* mesh, hm_network* network, double threshold, uint32_t max_sweeps,
               hm_relaxation* result);
  /* Null where there are no corrections. As `relax`, with the weights of the last `relax`: only bias and
     outputs travel. */
  int (*correct)(void* context, const hm_mesh* mesh, hm_network* network, double threshold,
                 uint32_t max_sweeps, hm_relaxation* result);
  /* The largest bias that fits beside those weights. */
  double (*room)(void* context);
} hm_solver;

/* Adds sweeps and cycles; `converged` becomes this one's. */
void hm_add_relaxation(hm_relaxation* sum, const hm_relaxation* one);

/* Relaxes from where the outputs are, which `start` keeps. Adds sweeps and cycles to the sum; its `converged`
   becomes this relaxation's. HM_OK, or the solver's error, which leaves the sum alone. */
int hm_relax(const hm_solver* solver, const hm_mesh* mesh, hm_network* network, double* start,
             double threshold, uint32_t max_sweeps, hm_relaxation* sum);

#ifdef __cplusplus
}
#endif

#endif
