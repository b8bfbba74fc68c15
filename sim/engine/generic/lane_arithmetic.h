// Arithmetic on sixteen rows side by side, in 64 bits, for the generic core and the clock-stepped engine:
// plain loops that the compiler turns into wide instructions, once for each kind of processor.
#pragma once

#include "sim/engine/overflow.h"
#include "sim/engine/rounding.h"

#include <cstddef>

namespace hopmesh::engine {

inline constexpr std::size_t lane_count = 16;

struct Swing {
  std::int64_t least, largest;
};

/// link[tap] <- plane[slot]: the inputs of sixteen rows from one plane of outputs.
void gather_lanes(const std::int32_t* plane, const std::uint32_t* slots, std::int32_t* links);
/// sums += weights * links over `taps` rows of lanes.
void add_lane_products(const std::int32_t* weights, const std::int32_t* links, std::size_t taps,
                       std::int64_t* sums);
/// A rounding accumulator: for each group of `group` taps x <- Q[x + products], products moved up by
/// `product_up` places to a last place that lies `rounding.places` below that of x.
void add_lane_groups(const std::int32_t* weights, const std::int32_t* links, std::size_t taps,
                     std::size_t group, int product_up, const ShiftRounding& rounding, const Limit& limit,
                     std::int64_t* x);
/// x <- x * 2^up / divisor rounded, 0 where the divisor is 0. |x| 2^up < 2^61, |quotient| < 2^50.
void divide_lanes(std::int64_t* x, int up, const std::int64_t* divisor, const RoundingRule& rule);
/// x <- x * 2^up + more * 2^more_up.
void shift_and_add_lanes(std::int64_t* x, int up, const std::int64_t* more, int more_up);
void multiply_lanes(std::int64_t* x, const std::int64_t* factor);
/// x <- x * factor rounded, held within [-bound, bound].
void scale_lanes(std::int64_t* x, const std::int64_t* factor, const ShiftRounding& rounding,
                 std::int64_t bound);
/// x <- x * factor * 2^-places rounded, each lane by its own places in [0, 60]; products fit 62 bits.
void scale_lanes_apart(std::int64_t* x, const std::int64_t* factor, const int* places,
                       const RoundingRule& rule);
void round_lanes(std::int64_t* x, const ShiftRounding& rounding);
/// Each code brought into the format's range.
void limit_lanes(std::int64_t* x, const Limit& limit);
/// x <- one, 0 or -one, by its sign.
void sign_lanes(std::int64_t* x, std::int64_t one);
void clamp_lanes(std::int64_t* x, std::int64_t bound);
/// x held within ±norm * factor; `beyond`: the sign of what was cut off, or 0.
void hold_lanes(std::int64_t* x, const std::int64_t* norm, std::int64_t factor, std::int64_t* beyond);
/// x clamped, and at its bound where `beyond` is not 0.
void limit_held_lanes(std::int64_t* x, const std::int64_t* beyond, std::int64_t bound);
void widen_swing(const std::int64_t* x, Swing& swing);
/// The largest |s| of rows that may still move: links do not show `base`, from where they move, at the bound
/// that s pushes to. `at_one`, `at_minus_one`: from there on they do.
std::int64_t largest_moving_sum(const std::int64_t* sum, const std::int32_t* base, std::int64_t at_one,
                                std::int64_t at_minus_one);
/// V <- V + Delta V for drives u; links from it; returns the largest |Delta V|.
std::int64_t output_lanes(const std::int64_t* u, std::int64_t one, const ShiftRounding& to_state,
                          const ShiftRounding& to_link, std::int32_t* state, std::int32_t* link);

/// u to a step of the state: moved up, then rounded.
struct StepRounding {
  int up = 0;
  ShiftRounding down;
};
/// `places`: from the drive down to the state.
StepRounding step_rounding(int places, const spec::NumberFormat& state);
/// Projected: V <- V + step, held within ±one; links from it; returns the largest |Delta V|.
std::int64_t step_lanes(const std::int64_t* u, std::int64_t one, const StepRounding& to_state,
                        const ShiftRounding& to_link, std::int32_t* state, std::int32_t* link);
/// Momentum: V <- Y + step, then Y <- V + m Delta V, both held within ±one; links from Y.
struct Moved {
  std::int64_t largest, along; ///< |Delta V|; the sum of sign(s) Delta V
};
struct Momentum {
  std::int64_t one, m;
  StepRounding to_state;
  ShiftRounding gained, to_link; ///< m Delta V to the state; Y to the link
};
Moved momentum_lanes(const std::int64_t* u, const std::int64_t* sum, const Momentum& stage,
                     std::int32_t* state, std::int32_t* ahead, std::int32_t* link);

} // namespace hopmesh::engine
