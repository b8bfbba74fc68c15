#include "sim/engine/kernels/once_weights.h"

namespace hopmesh::engine {

OnceWeights::OnceWeights(const Layout& layout, const FastLayout& fast, std::size_t per_cell,
                         const OnceKernels& kernels)
    : fast_(fast), per_cell_(per_cell), kernels_(kernels), layout_(layout, fast, per_cell) {
  if (!layout_.fits()) return;
  planes_.assign(layout_.planes() * layout_.stride(), 0);
  for (auto& links : links_) links.assign(per_cell * layout_.stride(), 0);
}

void OnceWeights::point(OnceArgs& args, std::size_t turn) {
  layout_.point(args);
  args.weight = planes_.data() + layout_.pad();
  args.link = links_[turn].data() + layout_.pad();
  args.next_link = links_[1 - turn].data() + layout_.pad();
}

// A block's weights that face backward are compared with planes that other blocks write.
bool OnceWeights::pack(const KernelArgs& args, std::size_t blocks) {
  if (fit_ != Fit::unknown) return fit_ == Fit::yes;
  std::uint32_t differ = 0;
  for (auto* step : {kernels_.pack[per_cell_ - 1], kernels_.compare[per_cell_ - 1]})
    for (std::size_t b = 0; b < blocks && differ == 0; ++b) {
      const auto& own = fast_.tap_place[fast_.neighbours[b]];
      differ |= step(
          args,
          {layout_.taps(b), own.data(), args.weight + fast_.first_weight[b], planes_.data() + layout_.pad()},
          b);
    }
  fit_ = differ == 0 ? Fit::yes : Fit::no;
  return differ == 0;
}

} // namespace hopmesh::engine
