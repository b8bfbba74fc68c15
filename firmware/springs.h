/* What springs hold and how long they are; positions are [nodes * 3]. */
#ifndef HOPMESH_FIRMWARE_SPRINGS_H
#define HOPMESH_FIRMWARE_SPRINGS_H

#include "firmware/network.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Energy of one spring with its ends at a and b. */
double hm_one_spring_energy(const hm_mesh* mesh, const hm_spring* spring, const double* a, const double* b);
double hm_spring_energy(const hm_mesh* mesh, const double* position);

double hm_longest_spring(const hm_mesh* mesh, const double* position);
/* Is the springs' energy a quadratic form of the positions, so that its expansion is exact anywhere? */
int hm_springs_are_quadratic(const hm_mesh* mesh);

#ifdef __cplusplus
}
#endif

#endif
