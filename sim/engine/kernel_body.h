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
    Rounder drive, state, link;
    Longs one, minus_one, flip_by_sign, flip_always, least_sum, largest_sum, least_drive, largest_drive,
        largest;
    typename Isa::Count bias_up, state_fraction, ratio_up;
    typename Isa::Doubles quarter, half;

    Stage(const KernelArgs& a, const KernelSwings& s)
        : args(a), drive(a.drive), state(a.state_rounding), link(a.link), one(Isa::all(a.one_drive)),
          minus_one(Isa::all(-a.one_drive)), flip_by_sign(Isa::all(a.division.flip_by_sign)),
          flip_always(Isa::all(a.division.flip_always)), least_sum(Isa::all(s.least_sum)),
          largest_sum(Isa::all(s.largest_sum)), least_drive(Isa::all(s.least_drive)),
          largest_drive(Isa::all(s.largest_drive)), largest(Isa::all(s.largest_change)),
          bias_up(Isa::count(a.bias_up)), state_fraction(Isa::count(a.state_fraction)),
          ratio_up(Isa::count(a.division.ratio_up)), quarter(Isa::all_doubles(0.25)),
          half(Isa::all_doubles(a.division.half)) {}

    void swings(KernelSwings& s) const {
      s.largest_change = Isa::largest(largest);
      s.least_sum = Isa::least(least_sum);
      s.largest_sum = Isa::largest(largest_sum);
      s.least_drive = Isa::least(least_drive);
      s.largest_drive = Isa::largest(largest_drive);
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
    const Longs change = rounded<plain>(product, c.state);
    c.largest = Isa::max(c.largest, Isa::absolute(change));
    return change;
  }

  /// The output stage of sixteen neurons; returns their links.
  template <Normalise how, bool plain, bool wide>
  static Words publish(const Sum<Isa, wide>& sum, std::size_t at, Stage& c) {
    const KernelArgs& a = c.args;
    const Words bias = Isa::load_words(a.bias + at), V = Isa::load_words(a.state + at);
    const Longs V0 = Isa::low(V), V1 = Isa::high(V);
    const Longs s0 = Isa::add(Isa::shift_up(Isa::low(bias), c.bias_up), sum.low());
    const Longs s1 = Isa::add(Isa::shift_up(Isa::high(bias), c.bias_up), sum.high());
    const Longs new0 = Isa::add(V0, change_of<how, plain>(s0, V0, a.multiplier + at, c));
    const Longs new1 = Isa::add(V1, change_of<how, plain>(s1, V1, a.multiplier + at + 8, c));
    Isa::store_words(a.state + at, Isa::narrow(new0, new1));
    return Isa::narrow(rounded<plain>(new0, c.link), rounded<plain>(new1, c.link));
  }

  static Words fetch(const std::uint32_t* plane, const Source& source, const std::uint32_t* far_slot) {
    if (source.kind == Source::together) return Isa::load_words(plane + source.base);
    if (source.kind == Source::near) return Isa::pick(plane + source.base, source.lane);
    return Isa::gather(plane, far_slot + source.base);
  }

  /// Neighbours' part of the sums of all neurons of sixteen cells; moves `w` of each row behind it.
  template <int P, bool wide>
  static void add_neighbours(const KernelArgs& a, std::size_t block, const std::uint32_t* w, std::size_t row,
                             Sum<Isa, wide> (&sum)[P]) {
    const std::size_t n = a.neighbours[block];
    const Source* source = a.source + a.first_source[block];
    const std::uint32_t* w_xy = w + 16;
    const std::uint32_t* w_zz = w + 16 * (1 + n);
    for (std::size_t k = 0; k < n; k += P == 3 ? 2 : 1) {
      const Words first = fetch(a.xy, source[k], a.far_slot);
      for (int p = 0; p < P; ++p) sum[p].add(first, w_xy + static_cast<std::size_t>(p) * row + 16 * k);
      if constexpr (P == 3) {
        const Words second = fetch(a.xy, source[k + 1], a.far_slot);
        const Words z =
            Isa::halves(fetch(a.zz, source[k], a.far_slot), fetch(a.zz, source[k + 1], a.far_slot));
        for (int p = 0; p < P; ++p) {
          sum[p].add(second, w_xy + static_cast<std::size_t>(p) * row + 16 * k + 16);
          sum[p].add(z, w_zz + static_cast<std::size_t>(p) * row + 8 * k);
        }
      }
    }
  }

  template <int P, Normalise how, bool plain, bool wide>
  static void fire_block(const KernelArgs& a, std::size_t block, Stage& c) {
    const std::size_t n = a.neighbours[block], row = 16 * (P == 3 ? 2 + n + n / 2 : 1 + n), slot = 16 * block;
    const std::uint32_t* w = a.weight + a.first_weight[block];
    Sum<Isa, wide> sum[P];
    add_neighbours<P, wide>(a, block, w, row, sum);
    Words xy = Isa::load_words(a.xy + slot), now_xy = xy, zz = P == 3 ? Isa::load_words(a.zz + slot) : xy;
    for (int p = 0; p < P; ++p, w += row) {
      sum[p].add(a.synchronous ? xy : now_xy, w);
      if constexpr (P == 3) sum[p].add(zz, w + row - 16);
      const Words link = publish<how, plain, wide>(sum[p], 16 * (P * block + static_cast<std::size_t>(p)), c);
      if (p == 0) now_xy = Isa::halves(link, now_xy);
      if (p == 1) now_xy = Isa::halves(now_xy, Isa::up_16(link));
      if (p == 2) Isa::store_words(a.next_zz + slot, Isa::halves(link, Isa::up_16(link)));
    }
    Isa::store_words(a.next_xy + slot, now_xy);
  }

  template <int P, Normalise how, bool plain, bool wide>
  static void fire(const KernelArgs& a, std::size_t first, std::size_t last, KernelSwings& swings) {
    Stage c(a, swings);
    for (std::size_t block = first; block < last; ++block) fire_block<P, how, plain, wide>(a, block, c);
    c.swings(swings);
  }

  template <int P> static void rows(const KernelArgs& a, std::size_t block, std::uint32_t* sums) {
    const std::size_t n = a.neighbours[block], pairs = P == 3 ? 2 + n + n / 2 : 1 + n;
    const std::uint32_t* w = a.weight + a.first_weight[block];
    for (int p = 0; p < P; ++p) {
      Words sum = Isa::no_words();
      for (std::size_t k = 0; k < pairs; ++k, w += 16) sum = Isa::add_magnitudes(sum, Isa::load_words(w));
      Isa::store_words(sums + 16 * p, sum);
    }
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
