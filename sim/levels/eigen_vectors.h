// Numbers between those who keep them in std::vector and those who compute with Eigen.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hopmesh::levels {

inline Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

inline std::vector<double> values_of(const Eigen::VectorXd& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

} // namespace hopmesh::levels
