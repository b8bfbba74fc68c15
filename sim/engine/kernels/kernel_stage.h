// The output stage of sixteen neurons, modified or binary, for any instruction set: a part of kernel_body.h.
#pragma once

#include "sim/engine/kernels/kernel_sum.h"

namespace hopmesh::engine {
namespace {

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
    Longs one, minus_one, least_sum, largest_sum, least_drive, largest_drive, moving, at_one, at_minus_one;
    typename Isa::Count link_places, bias_up, state_fraction, ratio_up;
    typename Isa::Doubles to_dividend, to_dividend_if_negative, to_quotient, to_quotient_if_negative;

    [[gnu::always_inline]] Stage(const KernelArgs& a, const LaneExtremes& s)
        : args(a), drive(a.drive), state(a.state_rounding), link_add(Isa::all_words(a.link.add)),
          link_add_if_negative(Isa::all_words(a.link.add_if_negative)),
          link_add_if_odd(Isa::all_words(a.link.add_if_odd)), largest(Isa::load_words(s.largest_change)),
          one(Isa::all(a.one_drive)), minus_one(Isa::all(-a.one_drive)), least_sum(Isa::load(s.least_sum)),
          largest_sum(Isa::load(s.largest_sum)), least_drive(Isa::load(s.least_drive)),
          largest_drive(Isa::load(s.largest_drive)), moving(Isa::load(s.largest_moving)),
          at_one(Isa::all(a.at_one)), at_minus_one(Isa::all(a.at_minus_one)),
          link_places(Isa::count(a.link.places)), bias_up(Isa::count(a.bias_up)),
          state_fraction(Isa::count(a.state_fraction)), ratio_up(Isa::count(a.division.ratio_up)),
          to_dividend(Isa::all_doubles(a.division.to_dividend)),
          to_dividend_if_negative(Isa::all_doubles(a.division.to_dividend_if_negative)),
          to_quotient(Isa::all_doubles(a.division.to_quotient)),
          to_quotient_if_negative(Isa::all_doubles(a.division.to_quotient_if_negative)) {}

    template <bool by_sum> void store_extremes(LaneExtremes& s) const {
      Isa::store_words(s.largest_change, largest);
      Isa::store(s.least_sum, least_sum);
      Isa::store(s.largest_sum, largest_sum);
      Isa::store(s.least_drive, least_drive);
      Isa::store(s.largest_drive, largest_drive);
      if constexpr (by_sum) Isa::store(s.largest_moving, moving);
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

  [[gnu::always_inline]] static void widen_swings(Longs s, Longs u, Stage& c) {
    c.least_sum = Isa::min(c.least_sum, s);
    c.largest_sum = Isa::max(c.largest_sum, s);
    c.least_drive = Isa::min(c.least_drive, u);
    c.largest_drive = Isa::max(c.largest_drive, u);
  }

  /// |s| of those that may still move: links do not show `base`, from where they move, at the bound that s
  /// pushes to.
  [[gnu::always_inline]] static void note_moving(Longs s, Longs base, Stage& c) {
    const Longs none = Isa::all(0);
    const Longs up = Isa::bits_and(Isa::max(s, none), Isa::signs(Isa::sub(base, c.at_one)));
    const Longs down =
        Isa::bits_and(Isa::max(Isa::sub(none, s), none), Isa::signs(Isa::sub(c.at_minus_one, base)));
    c.moving = Isa::max(c.moving, Isa::max(up, down));
  }

  /// s to Delta V for eight neurons. R u = u - V |u|, both with the places of V and u together.
  template <Normalise how, bool plain>
  [[gnu::always_inline]] static Longs change_of(Longs s, Longs V, const std::int64_t* multiplier, Stage& c) {
    const Longs u = drive_of<how, plain>(s, multiplier, c);
    widen_swings(s, u, c);
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

  /// s of the first eight neurons, and of the other eight.
  template <bool wide>
  [[gnu::always_inline]] static Longs low_sum(const Sum<Isa, wide>& sum, std::size_t at, const Stage& c) {
    return Isa::add(Isa::shift_up(Isa::load_widened(c.args.bias + at), c.bias_up), sum.low());
  }
  template <bool wide>
  [[gnu::always_inline]] static Longs high_sum(const Sum<Isa, wide>& sum, std::size_t at, const Stage& c) {
    return Isa::add(Isa::shift_up(Isa::load_widened(c.args.bias + at + 8), c.bias_up), sum.high());
  }

  /// The output stage of sixteen neurons; returns their links. |Delta V| may be 2^31: unsigned.
  template <Normalise how, bool plain, bool wide, bool by_sum>
  [[gnu::always_inline]] static Words publish(const Sum<Isa, wide>& sum, std::size_t at, Stage& c) {
    const KernelArgs& a = c.args;
    const Words V = Isa::load_words(a.state + at);
    const Longs s0 = low_sum(sum, at, c), s1 = high_sum(sum, at, c);
    const Longs V0 = Isa::load_widened(a.state + at), V1 = Isa::load_widened(a.state + at + 8);
    if constexpr (by_sum) note_moving(s0, V0, c), note_moving(s1, V1, c);
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
