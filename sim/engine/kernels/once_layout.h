// Which weights of a mesh stand for two, and where: for kernels that keep weights once (once_args.h). Made
// once for a mesh, from ways between slots that many cells share.
#pragma once

#include "sim/engine/kernels/fast_layout.h"

#include <map>

namespace hopmesh::engine {

class OnceLayout {
 public:
  OnceLayout(const Layout& layout, const FastLayout& fast, std::size_t per_cell);

  /// Is it worth while? Not where cells are linked in too many ways to share words and loads.
  bool fits() const { return fits_; }
  /// Fills in what kernels read of the layout.
  void point(OnceArgs& args) const;
  /// Taps of the block's list.
  const OnceTaps* taps(std::size_t block) const { return taps_.data() + first_taps_[block]; }

  std::size_t planes() const { return (1 + pair_count_) * kinds_; } ///< of weights
  std::size_t stride() const { return stride_; }
  std::size_t pad() const { return pad_; } ///< words before slot 0 of a plane
  /// Words of weights that a sweep reads, each once.
  std::size_t words_per_sweep() const { return words_; }

 private:
  void find_ways(const Layout& layout);
  void list_blocks(const Layout& layout, const FastLayout& fast);
  /// By way, in which columns of a block its neighbours stand.
  std::map<std::int64_t, std::uint32_t> columns(const Layout& layout, const FastLayout& fast,
                                                std::size_t block);
  /// Of a block's links on the two ways of a pair; false where there are none.
  bool add_taps(const std::map<std::int64_t, std::uint32_t>& column, const std::vector<std::uint32_t>& place,
                std::size_t pair, bool back);

  const std::size_t per_cell_, kinds_;
  std::size_t pair_count_ = 0, stride_ = 0, pad_ = 0, words_ = 0;
  bool fits_ = false;
  std::vector<std::uint32_t> ways_; ///< two of each pair; 0: none
  std::vector<OncePair> pairs_;
  std::vector<OnceList> lists_;
  std::vector<std::uint32_t> list_of_block_, first_taps_;
  std::vector<OnceTaps> taps_;
};

} // namespace hopmesh::engine
