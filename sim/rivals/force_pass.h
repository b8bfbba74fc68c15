// One pass over all springs: forces or energy. Springs whose nodes are equally far apart in number stand in
// rows (row r of a grid, whole grids of them), so a pass reads and writes neighbouring numbers and several
// springs share one instruction; the rest go through their node numbers.
#pragma once

#include "sim/scene/mesh.h"

#include <Eigen/Core>

namespace hopmesh::rivals {

using Vector = Eigen::VectorXd;
using In = const Eigen::Ref<const Vector>&; ///< [3 * nodes], component by component
using Out = Eigen::Ref<Vector>;

/// Springs of no length pull nowhere; this only keeps their division finite.
inline constexpr double shortest_spring = 1e-300;

class ForcePass {
 public:
  ForcePass(std::size_t nodes, const std::vector<scene::Spring>& springs);

  void forces(In position, Out force) const; ///< overwrites `force`
  double energy(In position) const;

 private:
  /// Springs first .. first + count of the arrays below. In a row, spring s joins node + s and node + s +
  /// distance; with distance 0 each spring names its nodes itself.
  struct Row {
    Eigen::Index first, count, node, distance;
  };
  struct Block;

  void add(const scene::Spring& spring);
  void add_row(const std::vector<scene::Spring>& sorted, std::size_t begin, std::size_t end);
  void differences(const Row& block, const double* position, Block& d) const;
  void lengths(const Row& block, Block& d) const;
  void spread(const Row& block, const Block& d, double* force) const;

  Eigen::Index nodes_;
  std::vector<double> stiffness_, rest_; ///< k = 2 alpha; a gap within a row is a spring of k = 0
  std::vector<std::uint32_t> from_, to_;
  std::vector<Row> blocks_; ///< rows cut to the size of a Block, so that all of it stays in the first cache
};

} // namespace hopmesh::rivals
