// The kernel for all instruction sets. `Isa` gives sixteen lanes of 32 bits (Words) and eight of 64 (Longs).
// Compiled once for each set, so everything here lives in an unnamed namespace and uses nothing of the
// standard library: code made for one processor must not be picked for another.
#pragma once

#include "sim/engine/kernels/kernel_slim.h"

namespace hopmesh::engine {
namespace {

template <typename Isa> struct Kernel : KernelSlim<Isa> {
  using typename KernelStage<Isa>::Words;
  using typename KernelStage<Isa>::Stage;

  /// Lanes of weight 0 may read what another thread writes (FastLayout::add_source): it counts for nothing.
  static Words fetch(const std::uint32_t* plane, const Source& source, const std::uint32_t* far_slot) {
    if (source.kind == Source::together) return Isa::load_links(plane + source.base);
    if (source.kind == Source::near) return Isa::pick(plane + source.base, source.lane);
    return Isa::gather(plane, far_slot + source.base);
  }

  /// Constants of the run and what is left behind; of projected arrays some more.
  template <bool held, bool = true> struct Stages {
    Stage c;
    [[gnu::always_inline]] Stages(const KernelArgs& a, const LaneExtremes& s) : c(a, s) {}
  };
  template <bool also> struct Stages<true, also> {
    Stage c;
    typename KernelHeld<Isa>::Held held;
    [[gnu::always_inline]] Stages(const KernelArgs& a, const LaneExtremes& s) : c(a, s), held(a, s) {}
  };

  template <Normalise how, bool plain, bool wide, bool by_sum>
  [[gnu::always_inline]] static Words publish(const Sum<Isa, wide>& sum, std::size_t at,
                                              Stages<is_step(how)>& c) {
    if constexpr (is_step(how))
      return KernelHeld<Isa>::template publish_step<how, plain, wide>(sum, at, c.c, c.held);
    else
      return KernelStage<Isa>::template publish<how, plain, wide, by_sum>(sum, at, c.c);
  }

  /// A block on its way through the three stages of `fire`. The sums of x, y and z are three members instead
  /// of an array, so that they stay in registers.
  template <int P, bool wide> struct Block {
    bool live = false;
    std::size_t slot = 0;
    const std::uint32_t* w = nullptr; ///< moves through the block's weights in the order in which they lie
    Sum<Isa, wide> x, y, z;
    Words xy = Isa::no_words();
    void add(Words links) {
      x.add(links, w);
      if constexpr (P > 1) y.add(links, w + 16);
      if constexpr (P == 3) z.add(links, w + 32);
      w += 16 * P;
    }

    /// Adds all inputs that need not wait for the cells' own neurons: those from neighbours, from the cell's
    /// z, and the own inputs of x.
    [[gnu::always_inline]] void load(const KernelArgs& a, std::size_t block) {
      live = true;
      slot = 16 * block;
      w = a.weight + a.first_weight[block];
      x = y = z = {};
      const Source* source = a.source + a.first_source[block];
      const Source* const end = source + a.neighbours[block];
      for (; source != end; source += P == 2 ? 1 : 2) {
        if constexpr (P > 1) add(fetch(a.xy, source[0], a.far_slot));
        if constexpr (P == 3) add(fetch(a.xy, source[1], a.far_slot));
        if constexpr (P != 2)
          add(Isa::halves(fetch(a.zz, source[0], a.far_slot), fetch(a.zz, source[1], a.far_slot)));
      }
      if constexpr (P != 2) add(Isa::load_words(a.zz + slot));
      if constexpr (P == 1) return;
      xy = Isa::load_words(a.xy + slot);
      x.add(xy, w);
      if (!a.synchronous) return;
      y.add(xy, w + 16);
      if constexpr (P == 3) z.add(xy, w + 32);
    }
  };

  // Cells of one neuron: nothing in a block waits, and the processor looks from one block into the next.
  template <Normalise how, bool plain, bool wide, bool by_sum>
  static void fire_single(const KernelArgs& a, std::size_t first, std::size_t last, LaneExtremes& extremes) {
    Stages<is_step(how)> c(a, extremes);
    Block<1, wide> at;
    for (std::size_t block = first; block < last; ++block) {
      at.load(a, block);
      const Words link = publish<how, plain, wide, by_sum>(at.x, at.slot, c);
      Isa::store_links(a.next_zz + at.slot, Isa::halves(link, Isa::up_16(link)));
    }
    c.c.template store_extremes<by_sum>(extremes);
  }

  // A cell's neurons wait for each other, a group's cells do not. So the z of one block fires beside the y of
  // the next, the x of the one after and the sums of a fourth: four short chains at a time instead of one
  // long one, which the processor could not look past. A block that reads what is still on its way waits for
  // it.
  template <int P, Normalise how, bool plain, bool wide, bool by_sum>
  static void fire(const KernelArgs& a, std::size_t first, std::size_t last, LaneExtremes& extremes) {
    if constexpr (P == 1) return fire_single<how, plain, wide, by_sum>(a, first, last, extremes);
    Stages<is_step(how)> c(a, extremes);
    Block<P, wide> summed, with_x, with_y;
    for (std::size_t block = first; true;) {
      if (P == 3 && with_y.live) {
        const Words link = publish<how, plain, wide, by_sum>(with_y.z, 3 * with_y.slot + 32, c);
        Isa::store_links(a.next_zz + with_y.slot, Isa::halves(link, Isa::up_16(link)));
      }
      with_y.live = P == 3 && with_x.live;
      if (with_x.live) {
        const Words link = publish<how, plain, wide, by_sum>(with_x.y, P * with_x.slot + 16, c);
        const Words xy = Isa::halves(with_x.xy, Isa::up_16(link));
        Isa::store_links(a.next_xy + with_x.slot, xy);
        with_y.slot = with_x.slot;
        with_y.z = with_x.z;
        if (P == 3 && !a.synchronous) with_y.z.add(xy, with_x.w + 32);
      }
      with_x.live = summed.live;
      if (summed.live) {
        with_x.xy = Isa::halves(publish<how, plain, wide, by_sum>(summed.x, P * summed.slot, c), summed.xy);
        with_x.slot = summed.slot;
        with_x.w = summed.w;
        with_x.y = summed.y;
        with_x.z = summed.z;
        if (!a.synchronous) with_x.y.add(with_x.xy, summed.w + 16);
      }
      const bool on_their_way = with_x.live || with_y.live;
      summed.live = false;
      if (block < last && !(on_their_way && a.waits[block]))
        summed.load(a, block++);
      else if (!on_their_way)
        break;
    }
    c.c.template store_extremes<by_sum>(extremes);
  }

  template <int P> static void rows(const KernelArgs& a, std::size_t block, std::uint32_t* sums) {
    const std::uint32_t *w = a.weight + a.first_weight[block], *const end =
                                                                   a.weight + a.first_weight[block + 1];
    Words sum[P];
    for (Words& s : sum) s = Isa::no_words();
    while (w != end)
      for (int p = 0; p < P; ++p, w += 16) sum[p] = Isa::add_magnitudes(sum[p], Isa::load_words(w));
    for (int p = 0; p < P; ++p) Isa::store_words(sums + 16 * p, sum[p]);
  }
};

} // namespace
} // namespace hopmesh::engine
