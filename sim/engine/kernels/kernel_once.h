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

  /// Outputs of sixteen cells, and what those on one way, or on two, show.
  template <int P> [[gnu::always_inline]] static Three links(const std::uint32_t* at, std::size_t stride) {
    return each<P>([&](std::size_t p)
                       __attribute__((always_inline)) { return Isa::load_links(at + p * stride); });
  }
  template <int P>
  [[gnu::always_inline]] static Three links(const std::uint32_t* at, const OncePair& pair,
                                            std::size_t stride) {
    const std::uint32_t *const low = at + pair.way[0], *const high = at + pair.way[1];
    return each<P>([&](std::size_t p)
                       __attribute__((always_inline)) { return both(low + p * stride, high + p * stride); });
  }

  /// s of sixteen cells. Planes are reached from the first and the fourth, as a processor adds up addresses.
  template <int P> [[gnu::always_inline]] static Three sums(const OnceArgs& o, std::size_t block) {
    const std::size_t slot = 16 * block, plane = o.stride, component = o.link_stride;
    const std::uint32_t *const own = o.weight + slot, *const link = o.link + slot;
    const auto plane_of = [plane](const std::uint32_t* first, const std::uint32_t* fourth, std::size_t k)
        __attribute__((always_inline)) {
      return k < 3 ? first + k * plane : fourth + (k - 3) * plane;
    };
    Three s = each<P>([&](std::size_t p) __attribute__((always_inline)) {
      return Isa::load_words(o.bias + (P * block + p) * 16);
    });
    add<P>(
        s, links<P>(link, component), [&](std::size_t k) __attribute__((always_inline)) {
          return Isa::load_words(plane_of(own, own + 3 * plane, k));
        });
    const OnceList& list = o.lists[o.list_of_block[block]];
    const OncePair *pair = o.pairs + list.first, *const middle = o.pairs + list.middle,
                   *const last = o.pairs + list.last;
    for (; pair != middle; ++pair) {
      const std::uint32_t *const first = own + pair->planes, *const fourth = first + 3 * plane;
      add<P>(
          s, links<P>(link, *pair, component), [&](std::size_t k) __attribute__((always_inline)) {
            return Isa::load_words(plane_of(first, fourth, k));
          });
    }
    for (; pair != last; ++pair) {
      const std::uint32_t *const low = own + pair->planes + pair->way[0], *const low_4 = low + 3 * plane;
      const std::uint32_t *const high = own + pair->planes + pair->way[1], *const high_4 = high + 3 * plane;
      add<P>(
          s, links<P>(link, *pair, component), [&](std::size_t k) __attribute__((always_inline)) {
            return both(plane_of(low, low_4, k), plane_of(high, high_4, k));
          });
    }
    return s;
  }

  template <int P, Normalise how, bool by_sum>
  static void fire_once(const KernelArgs& a, std::size_t first, std::size_t last, LaneExtremes& extremes) {
    constexpr bool brief = !divides(how);
    while (first < last) {
      const std::size_t end = last - first < a.slim_blocks ? last : first + a.slim_blocks;
      Slim c(a);
      Three s = sums<P>(a.once, first);
      for (; first < end; ++first) {
        const Three coming = sums<P>(a.once, first + 1 < end ? first + 1 : first);
        std::uint32_t* const next = a.once.next_link + 16 * first;
        const auto publish = [&](Words sum, std::size_t p) __attribute__((always_inline)) {
          const Words link =
              KernelSlim<Isa>::template publish_slim<how, by_sum, brief>(sum, (P * first + p) * 16, c);
          Isa::store_links(next + p * a.once.link_stride, Isa::twice(link));
        };
        publish(s.x, 0);
        if constexpr (P > 1) publish(s.y, 1);
        if constexpr (P > 2) publish(s.z, 2);
        s = coming;
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
