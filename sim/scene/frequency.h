// How fast the stiffest wave of a mesh swings: what the explicit limits dt omega = 2 and 2.83 are about.
#pragma once

#include "sim/scene/mesh.h"

namespace hopmesh::scene {

/// sqrt of the largest eigenvalue of K / m at the start, 1/s; a spring of weight alpha has k = 2 alpha.
double largest_frequency(const Mesh& mesh);

} // namespace hopmesh::scene
