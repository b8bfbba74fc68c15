// Nodes of a vector of coordinates, and how far two vectors are apart.
#pragma once

#include "sim/reference/reference.h"

namespace hopmesh::tests {

inline Eigen::Vector3d at(const reference::Vector& all, std::size_t node) {
  return all.segment<3>(3 * static_cast<Eigen::Index>(node));
}

/// The largest difference of two entries; 0 of empty vectors.
inline double difference(const reference::Vector& a, const reference::Vector& b) {
  return a.size() == 0 ? 0 : (a - b).cwiseAbs().maxCoeff();
}

} // namespace hopmesh::tests
