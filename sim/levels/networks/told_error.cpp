#include "sim/levels/networks/told_error.h"

#include "sim/levels/networks/definite_part.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::levels {

double ToldError::rms(std::size_t neurons) const {
  return neurons > 0 ? std::sqrt(error.squaredNorm() / static_cast<double>(neurons)) : 0;
}

std::vector<Eigen::Index> weighed_neurons(const reference::Network& network) {
  std::vector<Eigen::Index> all;
  for (Eigen::Index i = 0; i < network.W.rows(); ++i)
    for (reference::Matrix::InnerIterator w(network.W, i); w; ++w)
      if (w.value() != 0) {
        all.push_back(i);
        break;
      }
  return all;
}

std::optional<ToldError> told_error(const reference::Network& network, const Eigen::VectorXd& V) {
  const Eigen::VectorXd s = network.W * V + network.I;
  ToldError told{Eigen::VectorXd::Zero(V.size())};
  std::vector<Eigen::Index> free;
  for (const Eigen::Index i : weighed_neurons(network)) {
    const bool held = (V[i] >= 1 && s[i] > 0) || (V[i] <= -1 && s[i] < 0);
    if (held)
      ++told.held;
    else
      free.push_back(i);
  }
  const DefinitePart part(network.W, free, 0);
  if (!part.positive()) return std::nullopt;
  Eigen::VectorXd left(static_cast<Eigen::Index>(free.size()));
  for (Eigen::Index k = 0; k < left.size(); ++k) left[k] = s[free[static_cast<std::size_t>(k)]];
  const Eigen::VectorXd missing = part.solve(left); // V* - V
  for (Eigen::Index k = 0; k < left.size(); ++k) {
    const Eigen::Index i = free[static_cast<std::size_t>(k)];
    const double answer = V[i] + missing[k], boxed = std::max(-1.0, std::min(1.0, answer));
    told.error[i] = V[i] - boxed;
    if (boxed != answer) ++told.stopped;
  }
  return told;
}

} // namespace hopmesh::levels
