// Weights and links for kernels that keep weights once, and whether the weights at hand allow it.
#pragma once

#include "sim/engine/aligned.h"
#include "sim/engine/kernels/once_layout.h"

#include <array>

namespace hopmesh::engine {

class OnceWeights {
 public:
  OnceWeights(const Layout& layout, const FastLayout& fast, std::size_t per_cell, const OnceKernels& kernels);

  /// May these weights be kept once? Without a look at them, unless there was one.
  bool may_fit() const { return layout_.fits() && fit_ != Fit::no; }
  void change() { fit_ = Fit::unknown; }
  /// Packs them where they were written since the last time; are they symmetric and equal in both directions?
  bool pack(const KernelArgs& args, std::size_t blocks);

  const OnceKernels& kernels() const { return kernels_; }
  /// What kernels read in the sweep that takes links of this turn.
  void point(OnceArgs& args, std::size_t turn);
  std::size_t bytes_per_sweep() const { return 4 * layout_.words_per_sweep(); }

  void keep_links(std::size_t turn) { kept_ = links_[turn]; }
  void restore_links(std::size_t turn) { links_[turn] = kept_; }

 private:
  enum class Fit { unknown, yes, no };

  const FastLayout& fast_;
  const std::size_t per_cell_;
  const OnceKernels& kernels_;
  const OnceLayout layout_;
  Fit fit_ = Fit::unknown;
  AlignedVector<std::uint32_t> planes_, kept_;
  std::array<AlignedVector<std::uint32_t>, 2> links_;
};

} // namespace hopmesh::engine
