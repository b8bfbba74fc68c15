// Sweeps of momentum over weights that are kept once (once_args.h): blocks lie in the cells' own order, so
// neighbours, and weights that a neighbour keeps, stand side by side.
#pragma once

#include "sim/engine/kernels/kernel_slim.h"

namespace hopmesh::engine {
namespace {

template <typename Isa> struct KernelOnce : KernelSlim<Isa> {
  using typename KernelSlim<Isa>::Words;
  using typename KernelSlim<Isa>::Slim;

  struct Three {
    Words x = Isa::no_words(), y = Isa::no_words(), z = Isa::no_words();
  };

  /// Adds symmetric blocks of weights times links; `weights(plane)`: W[p][q] of xx, xy, yy, xz, yz, zz.
  template <int P, typename Weights>
  [[gnu::always_inline]] static void add(Three& s, const Three& link, Weights weights) {
    s.x = Isa::add_pairs(s.x, weights(0), link.x);
    if constexpr (P > 1) {
      const Words xy = weights(1);
      s.x = Isa::add_pairs(s.x, xy, link.y);
      s.y = Isa::add_pairs(Isa::add_pairs(s.y, xy, link.x), weights(2), link.y);
    }
    if constexpr (P > 2) {
      const Words xz = weights(3), yz = weights(4);
      s.x = Isa::add_pairs(s.x, xz, link.z);
      s.y = Isa::add_pairs(s.y, yz, link.z);
      s.z = Isa::add_pairs(Isa::add_pairs(s.z, xz, link.x), yz, link.y);
      s.z = Isa::add_pairs(s.z, weights(5), link.z);
    }
  }

  static Words both(const std::uint32_t* low, const std::uint32_t* high) {
    return Isa::halves(Isa::load_links(low), Isa::load_links(high));
  }
  template <int P, typename Load> [[gnu::always_inline]] static Three each(Load load) {
    Three r;
    r.x = load(0);
    if constexpr (P > 1) r.y = load(1);
    if constexpr (P > 2) r.z = load(2);
    return r;
  }

  /// s of sixteen cells.
  template <int P> [[gnu::always_inline]] static Three sums(const OnceArgs& o, std::size_t block) {
    const std::size_t slot = 16 * block, plane = o.stride, component = o.link_stride;
    const std::uint32_t *const own = o.weight + slot, *const link = o.link + slot;
    Three s = each<P>([&](std::size_t p) __attribute__((always_inline)) {
      return Isa::load_words(o.bias + (P * block + p) * 16);
    });
    add<P>(
        s, each<P>([&](std::size_t p) __attribute__((always_inline)) {
          return Isa::load_links(link + p * component);
        }),
        [&](std::size_t k) __attribute__((always_inline)) { return Isa::load_words(own + k * plane); });
    const OnceList& list = o.lists[o.list_of_block[block]];
    for (const OncePair *pair = o.pairs + list.first, *end = o.pairs + list.middle; pair != end; ++pair) {
      const std::uint32_t *const w = own + pair->planes * plane, *const low = link + pair->way[0],
                                 *const high = link + pair->way[1];
      add<P>(
          s, each<P>([&](std::size_t p) __attribute__((always_inline)) {
            return both(low + p * component, high + p * component);
          }),
          [&](std::size_t k) __attribute__((always_inline)) { return Isa::load_words(w + k * plane); });
    }
    for (const OncePair *pair = o.pairs + list.middle, *end = o.pairs + list.last; pair != end; ++pair) {
      const std::uint32_t *const w = own + pair->planes * plane, *const low = link - pair->way[0],
                                 *const high = link - pair->way[1];
      const std::uint32_t *const w_low = w - pair->way[0], *const w_high = w - pair->way[1];
      add<P>(
          s, each<P>([&](std::size_t p) __attribute__((always_inline)) {
            return both(low + p * component, high + p * component);
          }),
          [&](std::size_t k)
              __attribute__((always_inline)) { return both(w_low + k * plane, w_high + k * plane); });
    }
    return s;
  }

  template <int P, Normalise how, bool by_sum>
  static void fire_once(const KernelArgs& a, std::size_t first, std::size_t last, LaneExtremes& extremes) {
    constexpr bool brief = !divides(how);
    while (first < last) {
      const std::size_t end = last - first < a.slim_blocks ? last : first + a.slim_blocks;
      Slim c(a);
      for (; first < end; ++first) {
        const Three s = sums<P>(a.once, first);
        std::uint32_t* const next = a.once.next_link + 16 * first;
        const auto publish = [&](Words sum, std::size_t p) __attribute__((always_inline)) {
          const Words link =
              KernelSlim<Isa>::template publish_slim<how, by_sum, brief>(sum, (P * first + p) * 16, c);
          Isa::store_links(next + p * a.once.link_stride, Isa::twice(link));
        };
        publish(s.x, 0);
        if constexpr (P > 1) publish(s.y, 1);
        if constexpr (P > 2) publish(s.z, 2);
      }
      c.store_extremes(extremes);
    }
  }

  template <int P> static void show(const KernelArgs& a, std::size_t first, std::size_t last) {
    const Words add = Isa::all_words(a.link.add);
    const auto places = Isa::count(a.link.places);
    for (; first < last; ++first)
      for (std::size_t p = 0; p < P; ++p) {
        const std::size_t at = (P * first + p) * 16;
        const Words V = Isa::load_words(a.state + at);
        Isa::store_words(a.ahead + at, V);
        Isa::store_links(a.once.next_link + p * a.once.link_stride + 16 * first,
                         Isa::twice(Isa::shift_words_down(Isa::add_words(V, add), places)));
      }
  }
};

} // namespace
} // namespace hopmesh::engine
