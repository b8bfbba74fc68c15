/* The input s = I + W V of every neuron of the incremental potential's network, in double and from the mesh
   itself (docs/method/theory.md, section 9): what a correction has to take away. */
#ifndef HOPMESH_FIRMWARE_RESIDUAL_H
#define HOPMESH_FIRMWARE_RESIDUAL_H

#include "firmware/network.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of hm_network_build_incremental, and the point that the network was expanded about. */
typedef struct hm_increment {
  const double* predicted;
  double reach, inertia; /* inertia in kg/s^2 */
  const double* start;   /* V0, [cells * components] */
} hm_increment;

/* residual = I + W V, of the W and I about V0. */
void hm_residual(const hm_mesh* mesh, const hm_increment* about, const double* V, double* residual);

#ifdef __cplusplus
}
#endif

#endif
