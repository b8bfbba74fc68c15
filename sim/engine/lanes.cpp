#include "sim/engine/lanes.h"

// The loader picks the widest version that the processor can run.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define HM_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define HM_WIDEST
#endif

namespace hopmesh::engine {

namespace {

// Forced: a helper left outside would be compiled for the plainest processor only.
[[gnu::always_inline]] inline std::int64_t rounded(std::int64_t x, const LaneRounding& r) {
  return (x + r.add + ((x >> 63) & r.add_if_negative) + ((x >> r.places) & r.add_if_odd)) >> r.places;
}

} // namespace

LaneRounding lane_rounding(int places, spec::Rounding mode) {
  LaneRounding r;
  r.places = places;
  if (places == 0) return r;
  const std::int64_t unit = std::int64_t{1} << places, half = unit / 2;
  switch (mode) {
  case spec::Rounding::trn:
    break;
  case spec::Rounding::trn_zero:
    r.add_if_negative = unit - 1;
    break;
  case spec::Rounding::rnd:
    r.add = half;
    break;
  case spec::Rounding::rnd_min_inf:
    r.add = half - 1;
    break;
  case spec::Rounding::rnd_zero:
    r.add = half - 1;
    r.add_if_negative = 1;
    break;
  case spec::Rounding::rnd_inf:
    r.add = half;
    r.add_if_negative = -1;
    break;
  case spec::Rounding::rnd_conv:
    r.add = half - 1;
    r.add_if_odd = 1;
    break;
  }
  return r;
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

HM_WIDEST void round_lanes(std::int64_t* __restrict x, const LaneRounding& rounding) {
  const LaneRounding r = rounding;
  for (std::size_t l = 0; l < lane_count; ++l) x[l] = rounded(x[l], r);
}

HM_WIDEST void limit_lanes(std::int64_t* __restrict x, const spec::NumberFormat& f) {
  const std::int64_t high = f.max_raw(), low = f.min_raw();
  const int unused = 64 - f.width;
  if (f.overflow == spec::Overflow::wrap)
    for (std::size_t l = 0; l < lane_count; ++l)
      x[l] = static_cast<std::int64_t>(static_cast<std::uint64_t>(x[l]) << unused) >> unused;
  else if (f.overflow == spec::Overflow::sat_zero)
    for (std::size_t l = 0; l < lane_count; ++l) x[l] = low <= x[l] && x[l] <= high ? x[l] : 0;
  else
    for (std::size_t l = 0; l < lane_count; ++l) x[l] = x[l] < low ? low : x[l] > high ? high : x[l];
}

HM_WIDEST void clamp_lanes(std::int64_t* __restrict x, std::int64_t bound) {
  for (std::size_t l = 0; l < lane_count; ++l) x[l] = x[l] < -bound ? -bound : x[l] > bound ? bound : x[l];
}

HM_WIDEST void swing_lanes(const std::int64_t* x, LaneSwings& swings) {
  std::int64_t least = swings.least, largest = swings.largest;
  for (std::size_t l = 0; l < lane_count; ++l) {
    least = x[l] < least ? x[l] : least;
    largest = x[l] > largest ? x[l] : largest;
  }
  swings = {least, largest};
}

HM_WIDEST std::int64_t output_lanes(const std::int64_t* u, std::int64_t one, const LaneRounding& to_state,
                                    const LaneRounding& to_link, std::int32_t* __restrict state,
                                    std::int32_t* __restrict link) {
  const LaneRounding state_rounding = to_state, link_rounding = to_link;
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
