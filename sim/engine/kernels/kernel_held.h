// Output stages that hold u and V within limits, projected and momentum, for any array that fits: codes in 64
// bits. The second part of kernel_body.h.
#pragma once

#include "sim/engine/kernels/kernel_stage.h"

namespace hopmesh::engine {
namespace {

template <typename Isa> struct KernelHeld : KernelStage<Isa> {
  using typename KernelStage<Isa>::Words;
  using typename KernelStage<Isa>::Longs;
  using typename KernelStage<Isa>::Rounder;
  using typename KernelStage<Isa>::Stage;

  static Longs within(Longs x, Longs least, Longs most) { return Isa::min(Isa::max(x, least), most); }

  /// Constants of these stages, and what only they leave behind.
  struct Held {
    Rounder step, gained;
    Longs none, one, minus_one, most_drive, least_drive, m, along;
    typename Isa::Count step_up, beyond_up;
    typename Isa::Doubles gain;

    [[gnu::always_inline]] Held(const KernelArgs& a, const LaneExtremes& s)
        : step(a.step), gained(a.gained), none(Isa::all(0)), one(Isa::all(a.one_state)),
          minus_one(Isa::all(-a.one_state)), most_drive(Isa::all(a.most_drive)),
          least_drive(Isa::all(-a.most_drive)), m(Isa::all(a.momentum)), along(Isa::load(s.along)),
          step_up(Isa::count(a.step_up)), beyond_up(Isa::count(a.beyond_up)), gain(Isa::all_doubles(a.gain)) {
    }
  };

  /// As `divided`, with a gain of s.
  static Longs divided_gained(Longs s, const std::int64_t* inverse, const Stage& c, const Held& h) {
    const Longs x = Isa::shift_up(s, c.ratio_up), negative = Isa::signs(x);
    const auto more = Isa::plus(c.to_dividend, Isa::where(negative, c.to_dividend_if_negative));
    const auto last = Isa::plus(c.to_quotient, Isa::where(negative, c.to_quotient_if_negative));
    const auto dividend = Isa::plus(Isa::times(Isa::to_doubles(x), h.gain), more);
    return Isa::floor_longs(Isa::plus(Isa::times(dividend, Isa::load_doubles(inverse)), last));
  }

  /// u of eight neurons. s is held first, since it may be far more than its divisor; what that cuts off would
  /// lead beyond the limit.
  template <Normalise how, bool plain>
  [[gnu::always_inline]] static Longs held_drive(Longs s, std::size_t at, const Stage& c, const Held& h) {
    const Longs most = Isa::load(c.args.most_sum + at), held = within(s, Isa::sub(h.none, most), most);
    if constexpr (!divides(how)) {
      const Longs product = Isa::multiply(held, Isa::load(c.args.multiplier + at));
      return within(KernelStage<Isa>::template rounded<plain>(product, c.drive), h.least_drive, h.most_drive);
    }
    const Longs sign = within(Isa::sub(s, held), Isa::all(-1), Isa::all(1));
    const Longs u = divided_gained(held, c.args.multiplier + at, c, h);
    return within(Isa::add(u, Isa::shift_up(sign, h.beyond_up)), h.least_drive, h.most_drive);
  }

  /// V' of eight neurons, a step of u away from `base`.
  template <Normalise how, bool plain>
  [[gnu::always_inline]] static Longs stepped(Longs s, Longs base, std::size_t at, Stage& c, const Held& h) {
    const Longs u = held_drive<how, plain>(s, at, c, h);
    KernelStage<Isa>::widen_swings(s, u, c);
    const Longs step = KernelStage<Isa>::template rounded<plain>(Isa::shift_up(u, h.step_up), h.step);
    return within(Isa::add(base, step), h.minus_one, h.one);
  }

  /// Projected: sixteen neurons, and their links.
  template <Normalise how, bool plain, bool wide>
  [[gnu::always_inline]] static Words publish_step(const Sum<Isa, wide>& sum, std::size_t at, Stage& c,
                                                   const Held& h) {
    const KernelArgs& a = c.args;
    const Longs s0 = KernelStage<Isa>::low_sum(sum, at, c), s1 = KernelStage<Isa>::high_sum(sum, at, c);
    const Longs V0 = Isa::load_widened(a.state + at), V1 = Isa::load_widened(a.state + at + 8);
    KernelStage<Isa>::note_moving(s0, V0, c), KernelStage<Isa>::note_moving(s1, V1, c);
    const Words V = Isa::load_words(a.state + at);
    const Words now =
        Isa::narrow(stepped<how, plain>(s0, V0, at, c, h), stepped<how, plain>(s1, V1, at + 8, c, h));
    c.largest = Isa::max_unsigned(c.largest, Isa::word_sizes(Isa::sub_words(now, V)));
    Isa::store_words(a.state + at, now);
    return KernelStage<Isa>::template link_of<plain>(now, c);
  }

  /// Y' of eight neurons, from V and V'.
  [[gnu::always_inline]] static Longs ahead_of(Longs s, Longs V, Longs now, Held& h) {
    const Longs change = Isa::sub(now, V), sign = within(s, Isa::all(-1), Isa::all(1));
    h.along = Isa::add(h.along, Isa::multiply_low(sign, change));
    const Longs gained = KernelStage<Isa>::template rounded<false>(Isa::multiply_low(change, h.m), h.gained);
    return within(Isa::add(now, gained), h.minus_one, h.one);
  }

  /// Momentum: sixteen neurons, and their links.
  template <Normalise how>
  [[gnu::always_inline]] static Words publish_ahead(const Sum<Isa, true>& sum, std::size_t at, Stage& c,
                                                    Held& h) {
    const KernelArgs& a = c.args;
    const Longs s0 = KernelStage<Isa>::low_sum(sum, at, c), s1 = KernelStage<Isa>::high_sum(sum, at, c);
    const Longs Y0 = Isa::load_widened(a.ahead + at), Y1 = Isa::load_widened(a.ahead + at + 8);
    KernelStage<Isa>::note_moving(s0, Y0, c), KernelStage<Isa>::note_moving(s1, Y1, c);
    const Longs now0 = stepped<how, false>(s0, Y0, at, c, h),
                now1 = stepped<how, false>(s1, Y1, at + 8, c, h);
    const Words V = Isa::load_words(a.state + at), now = Isa::narrow(now0, now1);
    c.largest = Isa::max_unsigned(c.largest, Isa::word_sizes(Isa::sub_words(now, V)));
    const Words ahead = Isa::narrow(ahead_of(s0, Isa::low(V), now0, h), ahead_of(s1, Isa::high(V), now1, h));
    Isa::store_words(a.state + at, now);
    Isa::store_words(a.ahead + at, ahead);
    return KernelStage<Isa>::template link_of<false>(ahead, c);
  }
};

} // namespace
} // namespace hopmesh::engine
