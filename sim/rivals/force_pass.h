// A pass over all springs: forces, energy, or whatever is done block by block. Springs whose nodes are
// equally far apart in number stand in rows (row r of a grid, whole grids of them), so a pass reads and
// writes neighbouring numbers and several springs share one instruction; the rest go through their node
// numbers.
#pragma once

#include "sim/rivals/force_kernel.h"
#include "sim/scene/mesh.h"

#include <Eigen/Core>

namespace hopmesh::rivals {

using Vector = Eigen::VectorXd;
using In = const Eigen::Ref<const Vector>&; ///< [3 * nodes], component by component
using Out = Eigen::Ref<Vector>;

class ForcePass {
 public:
  ForcePass(std::size_t nodes, const std::vector<scene::Spring>& springs,
            const ForceKernel& kernel = force_kernels().back());

  void forces(In position, Out force) const; ///< overwrites `force`
  double energy(In position) const;
  const ForceKernel& kernel() const { return kernel_; }
  Eigen::Index nodes() const { return nodes_; }

  /// Springs of all blocks, gaps within rows among them; use(block, first) has each block and where it begins
  /// among them.
  Eigen::Index springs() const { return static_cast<Eigen::Index>(stiffness_.size()); }
  template <class Use> void each_block(Use use) const {
    for (const Row& row : rows_)
      use(Block{row.count, row.node, row.distance, &stiffness_[row.first], &rest_[row.first],
                &from_[row.first], &to_[row.first]},
          row.first);
  }

 private:
  /// Springs first .. first + count of the arrays below, as a Block of force_kernel.h.
  struct Row {
    Eigen::Index first, count, node, distance;
  };

  void add(const scene::Spring& spring);
  void add_row(const std::vector<scene::Spring>& sorted, std::size_t begin, std::size_t end);

  Eigen::Index nodes_;
  ForceKernel kernel_;
  std::vector<double> stiffness_, rest_; ///< k = 2 alpha; a gap within a row is a spring of k = 0
  std::vector<std::uint32_t> from_, to_;
  std::vector<Row> rows_; ///< cut to the size of a block
};

} // namespace hopmesh::rivals
