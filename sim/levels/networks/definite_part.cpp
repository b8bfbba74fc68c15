#include "sim/levels/networks/definite_part.h"

namespace hopmesh::levels {

DefinitePart::DefinitePart(const reference::Matrix& W, const std::vector<Eigen::Index>& outputs,
                           double shift) {
  std::vector<Eigen::Index> place(static_cast<std::size_t>(W.rows()), -1);
  for (std::size_t k = 0; k < outputs.size(); ++k) place[outputs[k]] = static_cast<Eigen::Index>(k);
  std::vector<Eigen::Triplet<double>> lower;
  for (const Eigen::Index i : outputs) {
    lower.emplace_back(place[i], place[i], shift);
    for (reference::Matrix::InnerIterator w(W, i); w; ++w)
      if (place[w.col()] >= 0 && place[w.col()] <= place[i])
        lower.emplace_back(place[i], place[w.col()], -w.value());
  }
  const auto n = static_cast<Eigen::Index>(outputs.size());
  Eigen::SparseMatrix<double> part(n, n);
  part.setFromTriplets(lower.begin(), lower.end());
  solver_.compute(part);
  positive_ = n == 0 || (solver_.info() == Eigen::Success && solver_.vectorD().minCoeff() > 0);
}

} // namespace hopmesh::levels
