// From weights as fast_layout.h has them to weights kept once (once_args.h), and whether that loses nothing.
#pragma once

#include "sim/engine/kernels/kernel_once.h"

namespace hopmesh::engine {
namespace {

template <typename Isa> struct KernelPack : KernelOnce<Isa> {
  using typename KernelOnce<Isa>::Words;

  /// Weights of two taps of neuron p of sixteen cells, the first in the lower half.
  static Words pair_of(const std::uint32_t* weight, std::size_t p, std::uint32_t low, std::uint32_t high) {
    const auto half = Isa::count(16);
    Words first = Isa::no_words(), second = first;
    if (low != OnceTaps::nowhere) {
      first = Isa::load_words(weight + 16 * p + low / 2);
      if (low % 2 == 1) first = Isa::shift_words_down(first, half);
    }
    if (high != OnceTaps::nowhere) {
      second = Isa::load_words(weight + 16 * p + high / 2);
      if (high % 2 == 0) second = Isa::up_16(second);
    }
    return Isa::halves(first, second);
  }

  /// Calls visit(plane, word) for the planes of a pair; adds up where W[p][q] and W[q][p] differ.
  template <int P, typename Visit>
  static void visit_planes(const std::uint32_t* weight, const OnceTaps& taps, Words& differ, Visit visit) {
    std::size_t plane = 0;
    for (std::size_t q = 0; q < P; ++q)
      for (std::size_t p = 0; p <= q; ++p, ++plane) {
        const Words w = pair_of(weight, p, taps.at[0][q], taps.at[1][q]);
        note(differ, w, pair_of(weight, q, taps.at[0][p], taps.at[1][p]));
        visit(plane, w);
      }
  }
  static void note(Words& differ, const Words& a, const Words& b) {
    differ = Isa::max_unsigned(differ, Isa::sub_words(a, b));
  }
  static std::uint32_t any(const Words& differ) {
    std::uint32_t lane[16], all = 0;
    Isa::store_words(lane, differ);
    for (std::uint32_t x : lane) all |= x;
    return all;
  }

  template <int P> static std::uint32_t pack(const KernelArgs& a, const OnceSource& from, std::size_t block) {
    const OnceArgs& o = a.once;
    const OnceList& list = o.lists[o.list_of_block[block]];
    std::uint32_t* const own = from.planes + 16 * block;
    Words differ = Isa::no_words();
    OnceTaps taps{};
    for (std::size_t q = 0; q < P; ++q) taps.at[0][q] = from.own_taps[q], taps.at[1][q] = OnceTaps::nowhere;
    visit_planes<P>(from.weight, taps, differ,
                    [&](std::size_t plane, const Words& w) { Isa::store_words(own + plane * o.stride, w); });
    for (std::uint32_t k = list.first; k < list.middle; ++k)
      visit_planes<P>(from.weight, from.taps[k - list.first], differ, [&](std::size_t plane, const Words& w) {
        Isa::store_words(own + o.pairs[k].planes + plane * o.stride, w);
      });
    return any(differ);
  }

  template <int P>
  static std::uint32_t compare(const KernelArgs& a, const OnceSource& from, std::size_t block) {
    const OnceArgs& o = a.once;
    const OnceList& list = o.lists[o.list_of_block[block]];
    Words differ = Isa::no_words();
    for (std::uint32_t k = list.middle; k < list.last; ++k) {
      const OncePair& pair = o.pairs[k];
      visit_planes<P>(from.weight, from.taps[k - list.first], differ, [&](std::size_t plane, const Words& w) {
        const std::uint32_t* const kept = o.weight + 16 * block + pair.planes + plane * o.stride;
        note(differ, w, KernelOnce<Isa>::both(kept + pair.way[0], kept + pair.way[1]));
      });
    }
    return any(differ);
  }
};

#define HM_ONCE(P, how)                                                                                      \
  { KernelOnce<Isa>::template fire_once<P, how, false>, KernelOnce<Isa>::template fire_once<P, how, true> }
#define HM_CELLS(P)                                                                                          \
  { HM_ONCE(P, Normalise::ahead_multiply), HM_ONCE(P, Normalise::ahead_divide) }

template <typename Isa> constexpr OnceKernels once_of() {
  using Pack = KernelPack<Isa>;
  using Once = KernelOnce<Isa>;
  return {{HM_CELLS(1), HM_CELLS(2), HM_CELLS(3)},
          {Pack::template pack<1>, Pack::template pack<2>, Pack::template pack<3>},
          {Pack::template compare<1>, Pack::template compare<2>, Pack::template compare<3>},
          {Once::template show<1>, Once::template show<2>, Once::template show<3>}};
}

#undef HM_CELLS
#undef HM_ONCE

} // namespace
} // namespace hopmesh::engine
