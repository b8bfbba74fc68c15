// One kernel for all instruction sets. `Isa` gives sixteen lanes of 32 bits (Words) and eight of 64 (Longs).
// Compiled once for each set, so everything here lives in an unnamed namespace and uses nothing of the
// standard library: code made for one processor must not be picked for another.
#pragma once

#include "sim/engine/kernel.h"

namespace hopmesh::engine {
namespace {

/// Sums of products of sixteen rows in 32 bits: for arrays whose every row fits.
template <typename Isa, bool wide> struct Sum {
  typename Isa::Words sum = Isa::no_words();
  void add(typename Isa::Words links, const std::uint32_t* weights) {
    sum = Isa::add_products(sum, links, weights);
  }
  typename Isa::Longs low() const { return Isa::low(sum); }
  typename Isa::Longs high() const { return Isa::high(sum); }
};

/// The same, pair by pair into 64 bits.
template <typename Isa> struct Sum<Isa, true> {
  typename Isa::Longs low_sum = Isa::all(0), high_sum = Isa::all(0);
  void add(typename Isa::Words links, const std::uint32_t* weights) {
    const auto pairs = Isa::add_products(Isa::no_words(), links, weights);
    low_sum = Isa::add(low_sum, Isa::low(pairs));
    high_sum = Isa::add(high_sum, Isa::high(pairs));
  }
  typename Isa::Longs low() const { return low_sum; }
  typename Isa::Longs high() const { return high_sum; }
};

template <typename Isa> struct Kernel {
  using Words = typename Isa::Words;
  using Longs = typename Isa::Longs;

  struct Rounder {
    Longs add, add_if_negative, add_if_odd;
    typename Isa::Count places;
    explicit Rounder(const KernelRounding& r)
        : add(Isa::all(r.add)), add_if_negative(Isa::all(r.add_if_negative)),
          add_if_odd(Isa::all(r.add_if_odd)), places(Isa::count(r.places)) {}
  };

  template <bool plain> static Longs rounded(Longs x, const Rounder& r) {
    Longs sum = Isa::add(x, r.add);
    if constexpr (!plain) {
      sum = Isa::add(sum, Isa::bits_and(Isa::signs(x), r.add_if_negative));
      sum = Isa::add(sum, Isa::bits_and(Isa::shift_down(x, r.places), r.add_if_odd));
    }
    return Isa::shift_down(sum, r.places);
  }

  /// Everything that stays the same from block to block.
  struct Stage {
    const KernelArgs& args;
    Rounder drive, state;
    Words link_add, link_add_if_negative, link_add_if_odd, largest;
    Longs one, minus_one, flip_by_sign, flip_always, least_sum, largest_sum, least_drive, largest_drive;
    typename Isa::Count link_places, bias_up, state_fraction, ratio_up;
    typename Isa::Doubles quarter, half;

    Stage(const KernelArgs& a, const KernelSwings& s)
        : args(a), drive(a.drive), state(a.state_rounding), link_add(Isa::all_words(a.link.add)),
          link_add_if_negative(Isa::all_words(a.link.add_if_negative)),
          link_add_if_odd(Isa::all_words(a.link.add_if_odd)), largest(Isa::load_words(s.largest_change)),
          one(Isa::all(a.one_drive)), minus_one(Isa::all(-a.one_drive)),
          flip_by_sign(Isa::all(a.division.flip_by_sign)), flip_always(Isa::all(a.division.flip_always)),
          least_sum(Isa::load(s.least_sum)), largest_sum(Isa::load(s.largest_sum)),
          least_drive(Isa::load(s.least_drive)), largest_drive(Isa::load(s.largest_drive)),
          link_places(Isa::count(a.link.places)), bias_up(Isa::count(a.bias_up)),
          state_fraction(Isa::count(a.state_fraction)), ratio_up(Isa::count(a.division.ratio_up)),
          quarter(Isa::all_doubles(0.25)), half(Isa::all_doubles(a.division.half)) {}

    void swings(KernelSwings& s) const {
      Isa::store_words(s.largest_change, largest);
      Isa::store(s.least_sum, least_sum);
      Isa::store(s.largest_sum, largest_sum);
      Isa::store(s.least_drive, least_drive);
      Isa::store(s.largest_drive, largest_drive);
    }
  };

  // floor(s / N) with a quarter of 1 / N to spare on either side: more than a double's error, since s and the
  // quotient have few enough bits (docs/engine.md).
  static Longs divided(Longs s, const std::int64_t* inverse, const Stage& c) {
    const Longs x = Isa::shift_up(s, c.ratio_up);
    const Longs flip = Isa::bits_xor(Isa::bits_and(Isa::signs(x), c.flip_by_sign), c.flip_always);
    const auto y = Isa::to_doubles(Isa::sub(Isa::bits_xor(x, flip), flip));
    const auto q = Isa::plus(Isa::times(Isa::plus(y, c.quarter), Isa::load_doubles(inverse)), c.half);
    return Isa::sub(Isa::bits_xor(Isa::floor_longs(q), flip), flip);
  }

  template <Normalise how, bool plain>
  static Longs drive_of(Longs s, const std::int64_t* multiplier, const Stage& c) {
    if constexpr (how == Normalise::divide) return divided(s, multiplier, c);
    if constexpr (how == Normalise::multiply)
      return rounded<plain>(Isa::multiply(s, Isa::load(multiplier)), c.drive);
    return Isa::min(Isa::max(rounded<plain>(s, c.drive), c.minus_one), c.one);
  }

  /// s to Delta V for eight neurons. R u = u - V |u|, both with the places of V and u together.
  template <Normalise how, bool plain>
  static Longs change_of(Longs s, Longs V, const std::int64_t* multiplier, Stage& c) {
    const Longs u = drive_of<how, plain>(s, multiplier, c);
    c.least_sum = Isa::min(c.least_sum, s);
    c.largest_sum = Isa::max(c.largest_sum, s);
    c.least_drive = Isa::min(c.least_drive, u);
    c.largest_drive = Isa::max(c.largest_drive, u);
    const Longs product =
        Isa::sub(Isa::shift_up(u, c.state_fraction), Isa::multiply_low(V, Isa::absolute(u)));
    return rounded<plain>(product, c.state);
  }

  /// V to its link. V has at most 31 bits of size, and so has all that is added.
  template <bool plain> static Words link_of(Words V, const Stage& c) {
    Words sum = Isa::add_words(V, c.link_add);
    if constexpr (!plain) {
      sum = Isa::add_words(sum, Isa::words_and(Isa::word_signs(V), c.link_add_if_negative));
      sum = Isa::add_words(sum, Isa::words_and(Isa::shift_words_down(V, c.link_places), c.link_add_if_odd));
    }
    return Isa::shift_words_down(sum, c.link_places);
  }

  /// The output stage of sixteen neurons; returns their links. |Delta V| may be 2^31: unsigned.
  template <Normalise how, bool plain, bool wide>
  static Words publish(const Sum<Isa, wide>& sum, std::size_t at, Stage& c) {
    const KernelArgs& a = c.args;
    const Words V = Isa::load_words(a.state + at);
    const Longs s0 = Isa::add(Isa::shift_up(Isa::load_widened(a.bias + at), c.bias_up), sum.low());
    const Longs s1 = Isa::add(Isa::shift_up(Isa::load_widened(a.bias + at + 8), c.bias_up), sum.high());
    const Longs V0 = Isa::load_widened(a.state + at), V1 = Isa::load_widened(a.state + at + 8);
    const Words change = Isa::narrow(change_of<how, plain>(s0, V0, a.multiplier + at, c),
                                     change_of<how, plain>(s1, V1, a.multiplier + at + 8, c));
    c.largest = Isa::max_unsigned(c.largest, Isa::word_sizes(change));
    const Words now = Isa::add_words(V, change);
    Isa::store_words(a.state + at, now);
    return link_of<plain>(now, c);
  }

  static Words fetch(const std::uint32_t* plane, const Source& source, const std::uint32_t* far_slot) {
    if (source.kind == Source::together) return Isa::load_words(plane + source.base);
    if (source.kind == Source::near) return Isa::pick(plane + source.base, source.lane);
    return Isa::gather(plane, far_slot + source.base);
  }

  /// A block on its way through the three stages of `fire`. The sums of x, y and z have names, not an array,
  /// so that they stay in registers.
  template <int P, bool wide> struct Block {
    bool live = false;
    std::size_t slot = 0;
    const std::uint32_t* w = nullptr; ///< moves through the block's weights in the order in which they lie
    Sum<Isa, wide> x, y, z;
    Words xy = Isa::no_words();

    void add(Words links) {
      x.add(links, w);
      y.add(links, w + 16);
      if constexpr (P == 3) z.add(links, w + 32);
      w += 16 * P;
    }

    /// All of the sums that does not wait for the cells' own neurons: neighbours, own z, and x's own inputs.
    void load(const KernelArgs& a, std::size_t block) {
      live = true;
      slot = 16 * block;
      w = a.weight + a.first_weight[block];
      x = y = z = {};
      const Source* source = a.source + a.first_source[block];
      const Source* const end = source + a.neighbours[block];
      for (; source != end; source += P == 3 ? 2 : 1) {
        add(fetch(a.xy, source[0], a.far_slot));
        if constexpr (P == 3) {
          add(fetch(a.xy, source[1], a.far_slot));
          add(Isa::halves(fetch(a.zz, source[0], a.far_slot), fetch(a.zz, source[1], a.far_slot)));
        }
      }
      if constexpr (P == 3) add(Isa::load_words(a.zz + slot));
      xy = Isa::load_words(a.xy + slot);
      x.add(xy, w);
      if (!a.synchronous) return;
      y.add(xy, w + 16);
      if constexpr (P == 3) z.add(xy, w + 32);
    }
  };

  // A cell's neurons wait for each other, a group's cells do not. So the z of one block fires beside the y of
  // the next, the x of the one after and the sums of a fourth: four short chains at a time instead of one
  // long one, which the processor could not look past. A block that reads what is still on its way waits for
  // it.
  template <int P, Normalise how, bool plain, bool wide>
  static void fire(const KernelArgs& a, std::size_t first, std::size_t last, KernelSwings& swings) {
    Stage c(a, swings);
    Block<P, wide> summed, with_x, with_y;
    for (std::size_t block = first; true;) {
      if (P == 3 && with_y.live) {
        const Words link = publish<how, plain>(with_y.z, 3 * with_y.slot + 32, c);
        Isa::store_words(a.next_zz + with_y.slot, Isa::halves(link, Isa::up_16(link)));
      }
      with_y.live = P == 3 && with_x.live;
      if (with_x.live) {
        const Words link = publish<how, plain>(with_x.y, P * with_x.slot + 16, c);
        const Words xy = Isa::halves(with_x.xy, Isa::up_16(link));
        Isa::store_words(a.next_xy + with_x.slot, xy);
        with_y.slot = with_x.slot;
        with_y.z = with_x.z;
        if (P == 3 && !a.synchronous) with_y.z.add(xy, with_x.w + 32);
      }
      with_x.live = summed.live;
      if (summed.live) {
        with_x.xy = Isa::halves(publish<how, plain>(summed.x, P * summed.slot, c), summed.xy);
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
    c.swings(swings);
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

#define HM_KERNELS(P, how)                                                                                   \
  {                                                                                                          \
    {Kernel<Isa>::template fire<P, how, false, false>, Kernel<Isa>::template fire<P, how, false, true>},     \
        {Kernel<Isa>::template fire<P, how, true, false>, Kernel<Isa>::template fire<P, how, true, true>},   \
  }

template <typename Isa> constexpr KernelSet kernels_of(const char* name) {
  return {name,
          {{HM_KERNELS(2, Normalise::multiply), HM_KERNELS(2, Normalise::scale),
            HM_KERNELS(2, Normalise::divide)},
           {HM_KERNELS(3, Normalise::multiply), HM_KERNELS(3, Normalise::scale),
            HM_KERNELS(3, Normalise::divide)}},
          {Kernel<Isa>::template rows<2>, Kernel<Isa>::template rows<3>}};
}

#undef HM_KERNELS

} // namespace
} // namespace hopmesh::engine
