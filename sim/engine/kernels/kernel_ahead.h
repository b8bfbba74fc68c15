// Sweeps of momentum, and all kernels of an instruction set: the last part of kernel_body.h.
#pragma once

#include "sim/engine/kernels/kernel_body.h"

namespace hopmesh::engine {
namespace {

/// All neurons fire at once, so nothing waits for anything.
template <typename Isa> struct KernelAhead : Kernel<Isa> {
  using typename Kernel<Isa>::Words;

  /// `publish(sum, p)` fires neuron p of sixteen cells and returns its links.
  template <int P, bool wide, typename Publish>
  [[gnu::always_inline]] static void fire_block(const KernelArgs& a, std::size_t block, Publish publish) {
    typename Kernel<Isa>::template Block<P, wide> at;
    at.load(a, block);
    const Words x = publish(at.x, 0);
    if constexpr (P == 1) return Isa::store_links(a.next_zz + at.slot, Isa::halves(x, Isa::up_16(x)));
    if constexpr (P > 1) Isa::store_links(a.next_xy + at.slot, Isa::halves(x, Isa::up_16(publish(at.y, 1))));
    if constexpr (P < 3) return;
    const Words z = publish(at.z, 2);
    Isa::store_links(a.next_zz + at.slot, Isa::halves(z, Isa::up_16(z)));
  }

  /// Whatever its formats and rows.
  template <int P, Normalise how>
  static void fire(const KernelArgs& a, std::size_t first, std::size_t last, LaneExtremes& extremes) {
    typename Kernel<Isa>::Stage c(a, extremes);
    typename KernelHeld<Isa>::Held h(a, extremes);
    for (std::size_t block = first; block < last; ++block)
      fire_block<P, true>(
          a, block, [&](const auto& sum, std::size_t p) __attribute__((always_inline)) {
            return KernelHeld<Isa>::template publish_ahead<how>(sum, (P * block + p) * 16, c, h);
          });
    c.template store_extremes<true>(extremes);
    Isa::store(extremes.along, h.along);
  }

  template <int P, Normalise how, bool by_sum>
  static void fire_slim(const KernelArgs& a, std::size_t first, std::size_t last, LaneExtremes& extremes) {
    while (first < last) {
      const std::size_t end = last - first < a.slim_blocks ? last : first + a.slim_blocks;
      typename KernelSlim<Isa>::Slim c(a);
      for (std::size_t block = first; block < end; ++block)
        fire_block<P, false>(
            a, block, [&](const auto& sum, std::size_t p) __attribute__((always_inline)) {
              const std::size_t at = (P * block + p) * 16;
              const Words s = Isa::add_words(sum.sum, Isa::load_words(a.once.bias + at));
              return KernelSlim<Isa>::template publish_slim<how, by_sum, false>(s, at, c);
            });
      c.store_extremes(extremes);
      first = end;
    }
  }

  template <int P, Normalise how, bool by_sum> static constexpr FireKernel slim() {
    if constexpr (Isa::few)
      return fire<P, how>;
    else
      return fire_slim<P, how, by_sum>;
  }
};

// Of modified and binary outputs: a kernel for rounding that only adds, and one for sums that 32 bits hold.
#define HM_FOUR(P, how)                                                                                      \
  {                                                                                                          \
    {Kernel<Isa>::template fire<P, how, false, false, false>,                                                \
     Kernel<Isa>::template fire<P, how, false, true, false>},                                                \
        {Kernel<Isa>::template fire<P, how, true, false, false>,                                             \
         Kernel<Isa>::template fire<P, how, true, true, false>},                                             \
  }
// With sums that are looked at: one for all.
#define HM_ONE(P, how)                                                                                       \
  HM_TWO((Kernel<Isa>::template fire<P, how, false, true, true>),                                            \
         (Kernel<Isa>::template fire<P, how, false, true, true>))
// The rest: a kernel where 32 bits hold what counts and rounding only adds, and one for all else.
#define HM_TWO(any, most)                                                                                    \
  {                                                                                                          \
    {any, any}, {                                                                                            \
      most, any                                                                                              \
    }                                                                                                        \
  }
#define HM_STEP(P, how)                                                                                      \
  HM_TWO((Kernel<Isa>::template fire<P, how, false, true, true>),                                            \
         (Kernel<Isa>::template fire<P, how, !Isa::few, Isa::few, true>))
#define HM_AHEAD(P, how, by_sum)                                                                             \
  HM_TWO((KernelAhead<Isa>::template fire<P, how>), (KernelAhead<Isa>::template slim<P, how, by_sum>()))
#define HM_CELLS(P)                                                                                          \
  {                                                                                                          \
    {HM_FOUR(P, Normalise::multiply), HM_ONE(P, Normalise::multiply)},                                       \
        {HM_FOUR(P, Normalise::scale), HM_ONE(P, Normalise::scale)},                                         \
        {HM_FOUR(P, Normalise::divide), HM_ONE(P, Normalise::divide)},                                       \
        {HM_FOUR(P, Normalise::sign), HM_ONE(P, Normalise::sign)},                                           \
        {HM_STEP(P, Normalise::step_multiply), HM_STEP(P, Normalise::step_multiply)},                        \
        {HM_STEP(P, Normalise::step_divide), HM_STEP(P, Normalise::step_divide)},                            \
        {HM_AHEAD(P, Normalise::ahead_multiply, false), HM_AHEAD(P, Normalise::ahead_multiply, true)},       \
        {HM_AHEAD(P, Normalise::ahead_divide, false), HM_AHEAD(P, Normalise::ahead_divide, true)},           \
  }

template <typename Isa> constexpr KernelSet kernels_of(const char* name, const OnceKernels* once) {
  return {name,
          !Isa::few,
          once,
          {HM_CELLS(1), HM_CELLS(2), HM_CELLS(3)},
          {Kernel<Isa>::template rows<1>, Kernel<Isa>::template rows<2>, Kernel<Isa>::template rows<3>}};
}

#undef HM_CELLS
#undef HM_AHEAD
#undef HM_STEP
#undef HM_TWO
#undef HM_ONE
#undef HM_FOUR

} // namespace
} // namespace hopmesh::engine
