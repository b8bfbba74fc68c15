// The output stage of sixteen neurons, for any instruction set: the first half of kernel_body.h.
#pragma once

#include "sim/engine/kernels/kernel.h"

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

/// Sums in 64 bits, added pair by pair: for arrays with a row that 32 bits do not hold.
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

/// What a kernel calls is forced into it: a call would spill every register (a third of the speed), and left
/// to itself a compiler that sees so many kernels calls.
template <typename Isa> struct KernelStage {
  using Words = typename Isa::Words;
  using Longs = typename Isa::Longs;

  struct Rounder {
    Longs add, add_if_negative, add_if_odd;
    typename Isa::Count places;
    explicit Rounder(const ShiftRounding& r)
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

  /// Constants of the run, and the extremes so far.
  struct Stage {
    const KernelArgs& args;
    Rounder drive, state;
    Words link_add, link_add_if_negative, link_add_if_odd, largest;
    Longs one, minus_one, least_sum, largest_sum, least_drive, largest_drive;
    typename Isa::Count link_places, bias_up, state_fraction, ratio_up;
    typename Isa::Doubles to_dividend, to_dividend_if_negative, to_quotient, to_quotient_if_negative;

    [[gnu::always_inline]] Stage(const KernelArgs& a, const LaneExtremes& s)
        : args(a), drive(a.drive), state(a.state_rounding), link_add(Isa::all_words(a.link.add)),
          link_add_if_negative(Isa::all_words(a.link.add_if_negative)),
          link_add_if_odd(Isa::all_words(a.link.add_if_odd)), largest(Isa::load_words(s.largest_change)),
          one(Isa::all(a.one_drive)), minus_one(Isa::all(-a.one_drive)), least_sum(Isa::load(s.least_sum)),
          largest_sum(Isa::load(s.largest_sum)), least_drive(Isa::load(s.least_drive)),
          largest_drive(Isa::load(s.largest_drive)), link_places(Isa::count(a.link.places)),
          bias_up(Isa::count(a.bias_up)), state_fraction(Isa::count(a.state_fraction)),
          ratio_up(Isa::count(a.division.ratio_up)), to_dividend(Isa::all_doubles(a.division.to_dividend)),
          to_dividend_if_negative(Isa::all_doubles(a.division.to_dividend_if_negative)),
          to_quotient(Isa::all_doubles(a.division.to_quotient)),
          to_quotient_if_negative(Isa::all_doubles(a.division.to_quotient_if_negative)) {}

    void store_extremes(LaneExtremes& s) const {
      Isa::store_words(s.largest_change, largest);
      Isa::store(s.least_sum, least_sum);
      Isa::store(s.largest_sum, largest_sum);
      Isa::store(s.least_drive, least_drive);
      Isa::store(s.largest_drive, largest_drive);
    }
  };

  static Longs divided(Longs s, const std::int64_t* inverse, const Stage& c) {
    const Longs x = Isa::shift_up(s, c.ratio_up), negative = Isa::signs(x);
    const auto more = Isa::plus(c.to_dividend, Isa::where(negative, c.to_dividend_if_negative));
    const auto last = Isa::plus(c.to_quotient, Isa::where(negative, c.to_quotient_if_negative));
    const auto dividend = Isa::plus(Isa::to_doubles(x), more);
    return Isa::floor_longs(Isa::plus(Isa::times(dividend, Isa::load_doubles(inverse)), last));
  }

  template <Normalise how, bool plain>
  static Longs drive_of(Longs s, const std::int64_t* multiplier, const Stage& c) {
    if constexpr (how == Normalise::divide) return divided(s, multiplier, c);
    if constexpr (how == Normalise::sign) // the state's rounding drops as many places as u has
      return Isa::shift_up(Isa::min(Isa::max(s, Isa::all(-1)), Isa::all(1)), c.state.places);
    if constexpr (how == Normalise::multiply)
      return rounded<plain>(Isa::multiply(s, Isa::load(multiplier)), c.drive);
    return Isa::min(Isa::max(rounded<plain>(s, c.drive), c.minus_one), c.one);
  }

  /// s to Delta V for eight neurons. R u = u - V |u|, both with the places of V and u together.
  template <Normalise how, bool plain>
  [[gnu::always_inline]] static Longs change_of(Longs s, Longs V, const std::int64_t* multiplier, Stage& c) {
    const Longs u = drive_of<how, plain>(s, multiplier, c);
    c.least_sum = Isa::min(c.least_sum, s);
    c.largest_sum = Isa::max(c.largest_sum, s);
    c.least_drive = Isa::min(c.least_drive, u);
    c.largest_drive = Isa::max(c.largest_drive, u);
    const Longs product =
        Isa::sub(Isa::shift_up(u, c.state_fraction), Isa::multiply_low(V, Isa::absolute(u)));
    return rounded<plain>(product, c.state);
  }

  /// V to its link. |V| has at most 31 bits, and so has all that is added.
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
  [[gnu::always_inline]] static Words publish(const Sum<Isa, wide>& sum, std::size_t at, Stage& c) {
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
};

} // namespace
} // namespace hopmesh::engine
