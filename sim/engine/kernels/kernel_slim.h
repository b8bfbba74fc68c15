// Momentum where every code of a sweep has 32 bits and u needs no more than a double: for arrays and rows
// that allow it (kernel_fit.h, fast_core.cpp). The third part of kernel_body.h.
#pragma once

#include "sim/engine/kernels/kernel_held.h"

namespace hopmesh::engine {
namespace {

template <typename Isa> struct KernelSlim : KernelHeld<Isa> {
  using typename KernelHeld<Isa>::Words;
  using typename KernelHeld<Isa>::Longs;
  using typename KernelHeld<Isa>::Stage;
  using Doubles = typename Isa::Doubles;

  /// Constants of the run, and the extremes so far.
  struct Slim {
    const KernelArgs& args;
    Words none, step_add, gained_add, low_bits, m, link_add, one, minus_one, at_one, at_minus_one;
    Words largest, least_sum, largest_sum, least_drive, largest_drive, moving, along, most_u, least_u;
    Longs half;
    Doubles scale, to_dividend, to_quotient, most_drive, fewest_drive;
    typename Isa::Count step_up, step_down, link_places, gain_places;

    [[gnu::always_inline]] explicit Slim(const KernelArgs& a)
        : args(a), none(Isa::no_words()), step_add(Isa::all_words(a.step.add)),
          gained_add(Isa::all_words(a.gained.add)), low_bits(Isa::all_words((1 << slim_places) - 1)),
          m(Isa::all_words(a.momentum & 0xFFFF)), link_add(Isa::all_words(a.link.add)),
          one(Isa::all_words(a.one_state)), minus_one(Isa::all_words(-a.one_state)),
          at_one(Isa::all_words(a.at_one)), at_minus_one(Isa::all_words(a.at_minus_one)), largest(none),
          least_sum(none), largest_sum(none), least_drive(none), largest_drive(none), moving(none),
          along(none), most_u(Isa::all_words(a.most_drive)), least_u(Isa::all_words(-a.most_drive)),
          half(Isa::all(a.once.half)), scale(Isa::all_doubles(a.slim.scale)),
          to_dividend(Isa::all_doubles(a.slim.to_dividend)),
          to_quotient(Isa::all_doubles(a.slim.to_quotient)),
          most_drive(Isa::all_doubles(static_cast<double>(a.most_drive))),
          fewest_drive(Isa::all_doubles(-static_cast<double>(a.most_drive))), step_up(Isa::count(a.step_up)),
          step_down(Isa::count(a.step.places)), link_places(Isa::count(a.link.places)),
          gain_places(Isa::count(slim_places)) {}

    // Sums that began at zero: of few enough blocks, so they fit.
    void store_extremes(LaneExtremes& s) const {
      Isa::store_words(s.largest_change, Isa::max_unsigned(Isa::load_words(s.largest_change), largest));
      least(s.least_sum, least_sum), most(s.largest_sum, largest_sum);
      least(s.least_drive, least_drive), most(s.largest_drive, largest_drive);
      most(s.largest_moving, moving);
      Isa::store(s.along, Isa::add(Isa::load(s.along), Isa::add(Isa::low(along), Isa::high(along))));
    }
    static void least(std::int64_t* all, Words x) {
      Isa::store(all, Isa::min(Isa::load(all), Isa::min(Isa::low(x), Isa::high(x))));
    }
    static void most(std::int64_t* all, Words x) {
      Isa::store(all, Isa::max(Isa::load(all), Isa::max(Isa::low(x), Isa::high(x))));
    }
  };

  static Words words_within(Words x, Words least, Words most) {
    return Isa::min_words(Isa::max_words(x, least), most);
  }

  template <Normalise how>
  [[gnu::always_inline]] static Doubles quotient(Doubles s, const std::int64_t* inverse, const Slim& c) {
    if constexpr (divides(how)) s = Isa::plus(Isa::times(s, c.scale), c.to_dividend);
    const Doubles u = Isa::plus(Isa::times(s, Isa::load_doubles(inverse)), c.to_quotient);
    return Isa::least_of(Isa::most_of(u, c.fewest_drive), c.most_drive);
  }

  /// m times the change, rounded to its last place: the change in two pieces, each 16 bits with its sign.
  [[gnu::always_inline]] static Words gained(Words low, Words high, const Slim& c) {
    const Words behind = Isa::shift_words_down(Isa::add_pairs(c.gained_add, low, c.m), c.gain_places);
    return Isa::add_pairs(behind, high, c.m);
  }

  /// |s| of those that may still move (KernelStage::note_moving).
  [[gnu::always_inline]] static void note_moving(Words s, Words Y, Slim& c) {
    const Words up = Isa::words_and(Isa::max_words(s, c.none), Isa::word_signs(Isa::sub_words(Y, c.at_one)));
    const Words down = Isa::words_and(Isa::max_words(Isa::sub_words(c.none, s), c.none),
                                      Isa::word_signs(Isa::sub_words(c.at_minus_one, Y)));
    c.moving = Isa::max_words(c.moving, Isa::max_words(up, down));
  }

  /// u of sixteen neurons. `brief`: one product of 32 bits each, whose upper half is u.
  template <Normalise how, bool brief>
  [[gnu::always_inline]] static Words drive_of_slim(Words s, std::size_t at, const Slim& c) {
    const KernelArgs& a = c.args;
    if constexpr (brief)
      return words_within(Isa::high_products(s, a.once.multiplier + at, c.half), c.least_u, c.most_u);
    else
      return Isa::floor_words(quotient<how>(Isa::low_doubles(s), a.multiplier + at, c),
                              quotient<how>(Isa::high_doubles(s), a.multiplier + at + 8, c));
  }

  /// Sixteen neurons, and their links. `brief`, where u is no finer than the state.
  template <Normalise how, bool by_sum, bool brief>
  [[gnu::always_inline]] static Words publish_slim(Words s, std::size_t at, Slim& c) {
    const KernelArgs& a = c.args;
    const Words Y = Isa::load_words(a.ahead + at);
    if constexpr (by_sum) note_moving(s, Y, c);
    c.least_sum = Isa::min_words(c.least_sum, s), c.largest_sum = Isa::max_words(c.largest_sum, s);
    const Words u = drive_of_slim<how, brief>(s, at, c);
    c.least_drive = Isa::min_words(c.least_drive, u), c.largest_drive = Isa::max_words(c.largest_drive, u);
    Words step = Isa::shift_words_up(u, c.step_up);
    if constexpr (!brief) step = Isa::shift_words_down(Isa::add_words(step, c.step_add), c.step_down);
    const Words now = words_within(Isa::add_words(Y, step), c.minus_one, c.one);
    const Words change = Isa::sub_words(now, Isa::load_words(a.state + at));
    Isa::store_words(a.state + at, now);
    c.largest = Isa::max_unsigned(c.largest, Isa::word_sizes(change));
    c.along = Isa::add_along(c.along, change, s);
    const Words low = Isa::words_and(change, c.low_bits), high = Isa::shift_words_down(change, c.gain_places);
    const Words ahead = words_within(Isa::add_words(now, gained(low, high, c)), c.minus_one, c.one);
    Isa::store_words(a.ahead + at, ahead);
    return Isa::shift_words_down(Isa::add_words(ahead, c.link_add), c.link_places);
  }
};

} // namespace
} // namespace hopmesh::engine
