#include "sim/engine/generic/lane_arithmetic.h"

#include "sim/engine/widest.h"

#include <cstring>

namespace hopmesh::engine {

namespace {

/// Eight lanes as a type: the compiler would take an array of sixteen apart before it makes them wide.
using Wide = std::int64_t __attribute__((vector_size(64)));
using Narrow = std::int32_t __attribute__((vector_size(32)));
constexpr std::size_t wide_lanes = 8;

[[gnu::always_inline]] inline void widen(Wide& wide, const std::int32_t* from) {
  Narrow narrow;
  std::memcpy(&narrow, from, sizeof narrow);
  wide = __builtin_convertvector(narrow, Wide);
}

template <bool wrap, bool zero> [[gnu::always_inline]] inline void hold(Wide& sum, const Limit& f) {
  if (wrap)
    sum = (sum << f.unused) >> f.unused;
  else if (zero)
    sum &= (sum >= f.low) & (sum <= f.high);
  else
    sum = sum < f.low ? Wide{} + f.low : sum > f.high ? Wide{} + f.high : sum;
}

/// A beat of a rounding accumulator. Each beat waits for the sum of the beat before, so as much as can be
/// is computed without that sum: the sum is a whole number, and floor(sum + x) = sum + floor(x). Rounding to
/// even then takes a tie down, and up again where an odd sum is left.
template <bool sign_matters, bool odd_matters>
[[gnu::always_inline]] inline void add_rounded(Wide& sum, const Wide& more, const ShiftRounding& r) {
  if (sign_matters) {
    const Wide fine = (sum << r.places) + more;
    sum = (fine + r.add + ((fine >> 63) & r.add_if_negative)) >> r.places;
    return;
  }
  const Wide down = (more + r.add) >> r.places;
  sum += down;
  if (odd_matters) sum += (((more + r.add + 1) >> r.places) - down) & sum;
}

template <bool wrap, bool zero, bool sign_matters, bool odd_matters>
[[gnu::always_inline]] inline void
add_groups(const std::int32_t* weights, const std::int32_t* links, std::size_t taps, std::size_t group,
           int product_up, const ShiftRounding& rounding, const Limit& f, std::int64_t* x) {
  const ShiftRounding r = rounding;
  Wide low_sum, high_sum, w, in;
  std::memcpy(&low_sum, x, sizeof low_sum);
  std::memcpy(&high_sum, x + wide_lanes, sizeof high_sum);
  for (std::size_t t = 0; t < taps;) {
    Wide low = {}, high = {};
    const std::size_t end = t + group < taps ? t + group : taps;
    for (; t < end; ++t, weights += lane_count, links += lane_count) {
      widen(w, weights), widen(in, links);
      low += w * in;
      widen(w, weights + wide_lanes), widen(in, links + wide_lanes);
      high += w * in;
    }
    add_rounded<sign_matters, odd_matters>(low_sum, low << product_up, r);
    add_rounded<sign_matters, odd_matters>(high_sum, high << product_up, r);
    if (wrap && !sign_matters) continue; // what lies above the word changes nothing within it
    hold<wrap, zero>(low_sum, f), hold<wrap, zero>(high_sum, f);
  }
  if (wrap) hold<wrap, zero>(low_sum, f), hold<wrap, zero>(high_sum, f);
  std::memcpy(x, &low_sum, sizeof low_sum);
  std::memcpy(x + wide_lanes, &high_sum, sizeof high_sum);
}

template <bool wrap, bool zero>
[[gnu::always_inline]] inline void add_groups(const std::int32_t* weights, const std::int32_t* links,
                                              std::size_t taps, std::size_t group, int product_up,
                                              const ShiftRounding& r, const Limit& f, std::int64_t* x) {
  if (r.add_if_odd)
    add_groups<wrap, zero, false, true>(weights, links, taps, group, product_up, r, f, x);
  else if (r.add_if_negative)
    add_groups<wrap, zero, true, false>(weights, links, taps, group, product_up, r, f, x);
  else
    add_groups<wrap, zero, false, false>(weights, links, taps, group, product_up, r, f, x);
}

} // namespace

StepRounding step_rounding(int places, const spec::NumberFormat& state) {
  return {std::max(-places, 0), shift_rounding(std::max(places, 0), state.rounding)};
}

HM_WIDEST void gather_lanes(const std::int32_t* plane, const std::uint32_t* slots,
                            std::int32_t* __restrict links) {
  for (std::size_t l = 0; l < lane_count; ++l) links[l] = plane[slots[l]];
}

HM_WIDEST void add_lane_products(const std::int32_t* weights, const std::int32_t* links, std::size_t taps,
                                 std::int64_t* __restrict sums) {
  std::int64_t sum[lane_count];
  for (std::size_t l = 0; l < lane_count; ++l) sum[l] = sums[l];
  for (std::size_t t = 0; t < taps; ++t, weights += lane_count, links += lane_count)
    for (std::size_t l = 0; l < lane_count; ++l) sum[l] += std::int64_t{weights[l]} * links[l];
  for (std::size_t l = 0; l < lane_count; ++l) sums[l] = sum[l];
}

HM_WIDEST void shift_and_add_lanes(std::int64_t* __restrict x, int up, const std::int64_t* more,
                                   int more_up) {
  const std::int64_t by = std::int64_t{1} << up, more_by = std::int64_t{1} << more_up;
  for (std::size_t l = 0; l < lane_count; ++l) x[l] = x[l] * by + more[l] * more_by;
}

HM_WIDEST void multiply_lanes(std::int64_t* __restrict x, const std::int64_t* factor) {
  for (std::size_t l = 0; l < lane_count; ++l) x[l] *= factor[l];
}

HM_WIDEST void scale_lanes(std::int64_t* __restrict x, const std::int64_t* __restrict factor,
                           const ShiftRounding& rounding, std::int64_t bound) {
  const ShiftRounding r = rounding;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t y = rounded(x[l] * factor[l], r);
    x[l] = y < -bound ? -bound : y > bound ? bound : y;
  }
}

HM_WIDEST void scale_lanes_apart(std::int64_t* __restrict x, const std::int64_t* __restrict factor,
                                 const int* __restrict places, const RoundingRule& rounding) {
  const RoundingRule rule = rounding;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t down = places[l], half_unit = (std::int64_t{1} << down) >> 1, y = x[l] * factor[l];
    const std::int64_t rounds = -static_cast<std::int64_t>(down > 0);
    const std::int64_t more = rule.add(half_unit) + ((y >> 63) & rule.add_if_negative(half_unit)) +
                              ((y >> down) & rule.ones_if_odd);
    x[l] = (y + (more & rounds)) >> down;
  }
}

HM_WIDEST void round_lanes(std::int64_t* __restrict x, const ShiftRounding& rounding) {
  const ShiftRounding r = rounding;
  for (std::size_t l = 0; l < lane_count; ++l) x[l] = rounded(x[l], r);
}

HM_WIDEST void limit_lanes(std::int64_t* __restrict x, const Limit& limit) {
  const Limit f = limit;
  if (f.unused > 0)
    for (std::size_t l = 0; l < lane_count; ++l) x[l] = limited<true, false>(x[l], f);
  else if (f.zero)
    for (std::size_t l = 0; l < lane_count; ++l) x[l] = limited<false, true>(x[l], f);
  else
    for (std::size_t l = 0; l < lane_count; ++l) x[l] = limited<false, false>(x[l], f);
}

HM_WIDEST void add_lane_groups(const std::int32_t* weights, const std::int32_t* links, std::size_t taps,
                               std::size_t group, int product_up, const ShiftRounding& r, const Limit& limit,
                               std::int64_t* x) {
  const Limit f = limit;
  if (f.unused > 0)
    add_groups<true, false>(weights, links, taps, group, product_up, r, f, x);
  else if (f.zero)
    add_groups<false, true>(weights, links, taps, group, product_up, r, f, x);
  else
    add_groups<false, false>(weights, links, taps, group, product_up, r, f, x);
}

// The quotient of doubles is at most one off: the exact rest puts it right, and says how to round.
HM_WIDEST void divide_lanes(std::int64_t* __restrict x, int up, const std::int64_t* divisor,
                            const RoundingRule& rounding) {
  const RoundingRule rule = rounding;
  const std::int64_t by = std::int64_t{1} << up;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t n = x[l] * by, none = divisor[l] == 0, d = divisor[l] + none;
    const std::int64_t near = static_cast<std::int64_t>(static_cast<double>(n) / static_cast<double>(d));
    const std::int64_t near_rest = n - near * d;
    const std::int64_t step =
        static_cast<std::int64_t>(near_rest >= d) - static_cast<std::int64_t>(near_rest < 0);
    const std::int64_t floor = near + step, rest = near_rest - step * d;
    const std::int64_t more =
        rule.add(d) + ((n >> 63) & rule.add_if_negative(d)) + (floor & rule.ones_if_odd);
    x[l] = none ? 0 : floor + (2 * rest + more >= 2 * d);
  }
}

HM_WIDEST void sign_lanes(std::int64_t* __restrict x, std::int64_t one) {
  for (std::size_t l = 0; l < lane_count; ++l) x[l] = x[l] < 0 ? -one : x[l] > 0 ? one : 0;
}

HM_WIDEST void clamp_lanes(std::int64_t* __restrict x, std::int64_t bound) {
  for (std::size_t l = 0; l < lane_count; ++l) x[l] = x[l] < -bound ? -bound : x[l] > bound ? bound : x[l];
}

HM_WIDEST void hold_lanes(std::int64_t* __restrict x, const std::int64_t* __restrict norm,
                          std::int64_t factor, std::int64_t* __restrict beyond) {
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t most = norm[l] * factor;
    beyond[l] = static_cast<std::int64_t>(x[l] > most) - static_cast<std::int64_t>(x[l] < -most);
    x[l] = x[l] < -most ? -most : x[l] > most ? most : x[l];
  }
}

HM_WIDEST void limit_held_lanes(std::int64_t* __restrict x, const std::int64_t* __restrict beyond,
                                std::int64_t bound) {
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t within = x[l] < -bound ? -bound : x[l] > bound ? bound : x[l];
    x[l] = beyond[l] == 0 ? within : beyond[l] * bound;
  }
}

HM_WIDEST std::int64_t largest_moving_sum(const std::int64_t* sum, const std::int32_t* base,
                                          std::int64_t at_one, std::int64_t at_minus_one) {
  std::int64_t largest = 0;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t up = base[l] >= at_one || sum[l] < 0 ? 0 : sum[l];
    const std::int64_t down = base[l] <= at_minus_one || sum[l] > 0 ? 0 : -sum[l];
    largest = up > largest ? up : largest;
    largest = down > largest ? down : largest;
  }
  return largest;
}

HM_WIDEST std::int64_t step_lanes(const std::int64_t* __restrict u, std::int64_t one,
                                  const StepRounding& to_state, const ShiftRounding& to_link,
                                  std::int32_t* __restrict state, std::int32_t* __restrict link) {
  const ShiftRounding down = to_state.down, link_rounding = to_link;
  const std::int64_t up = std::int64_t{1} << to_state.up;
  std::int64_t largest = 0;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t V = state[l], next = V + rounded(u[l] * up, down);
    const std::int64_t now = next < -one ? -one : next > one ? one : next;
    const std::int64_t size = now > V ? now - V : V - now;
    largest = size > largest ? size : largest;
    state[l] = static_cast<std::int32_t>(now);
    link[l] = static_cast<std::int32_t>(rounded(now, link_rounding));
  }
  return largest;
}

HM_WIDEST Moved momentum_lanes(const std::int64_t* __restrict u, const std::int64_t* __restrict sum,
                               const Momentum& stage, std::int32_t* __restrict state,
                               std::int32_t* __restrict ahead, std::int32_t* __restrict link) {
  const Momentum by = stage;
  const std::int64_t one = by.one, up = std::int64_t{1} << by.to_state.up;
  Moved moved{0, 0};
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t next = ahead[l] + rounded(u[l] * up, by.to_state.down);
    const std::int64_t V = next < -one ? -one : next > one ? one : next, change = V - state[l];
    const std::int64_t far = V + rounded(by.m * change, by.gained);
    const std::int64_t Y = far < -one ? -one : far > one ? one : far, size = change < 0 ? -change : change;
    moved.largest = size > moved.largest ? size : moved.largest;
    moved.along += sum[l] > 0 ? change : sum[l] < 0 ? -change : 0;
    state[l] = static_cast<std::int32_t>(V);
    ahead[l] = static_cast<std::int32_t>(Y);
    link[l] = static_cast<std::int32_t>(rounded(Y, by.to_link));
  }
  return moved;
}

HM_WIDEST void widen_swing(const std::int64_t* x, Swing& swing) {
  std::int64_t least = swing.least, largest = swing.largest;
  for (std::size_t l = 0; l < lane_count; ++l) {
    least = x[l] < least ? x[l] : least;
    largest = x[l] > largest ? x[l] : largest;
  }
  swing = {least, largest};
}

HM_WIDEST std::int64_t output_lanes(const std::int64_t* u, std::int64_t one, const ShiftRounding& to_state,
                                    const ShiftRounding& to_link, std::int32_t* __restrict state,
                                    std::int32_t* __restrict link) {
  const ShiftRounding state_rounding = to_state, link_rounding = to_link;
  std::int64_t largest = 0;
  for (std::size_t l = 0; l < lane_count; ++l) {
    const std::int64_t V = state[l], R = u[l] >= 0 ? one - V : one + V;
    const std::int64_t change = rounded(R * u[l], state_rounding), size = change < 0 ? -change : change;
    largest = size > largest ? size : largest;
    state[l] = static_cast<std::int32_t>(V + change);
    link[l] = static_cast<std::int32_t>(rounded(V + change, link_rounding));
  }
  return largest;
}

} // namespace hopmesh::engine
