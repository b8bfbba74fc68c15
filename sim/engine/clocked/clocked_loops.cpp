#include "sim/engine/clocked/clocked_loops.h"

#include "sim/engine/widest.h"

namespace hopmesh::engine {

// Loops over rows stand by themselves: inside another loop the compiler would look for a nest to interchange.
HM_WIDEST void add_tap(const std::int32_t* __restrict weights, const std::int32_t* __restrict links,
                       std::size_t rows, std::int64_t* __restrict sums) {
  for (std::size_t r = 0; r < rows; ++r) sums[r] += std::int64_t{weights[r]} * links[r];
}

HM_WIDEST void add_short_tap(const std::int32_t* __restrict weights, const std::int32_t* __restrict links,
                             std::size_t rows, std::int64_t* __restrict sums) {
  for (std::size_t r = 0; r < rows; ++r) sums[r] += std::int64_t{weights[r] * links[r]};
}

// Many clocks at once: the sums stay in the registers of the processor.
HM_WIDEST void add_products(const std::int32_t* __restrict weights, std::size_t weight_stride,
                            const std::int32_t* __restrict links, std::size_t link_stride, std::size_t taps,
                            std::int64_t* __restrict sums) {
  std::int64_t sum[lane_count];
  for (std::size_t l = 0; l < lane_count; ++l) sum[l] = sums[l];
  for (std::size_t t = 0; t < taps; ++t, weights += weight_stride, links += link_stride)
    for (std::size_t l = 0; l < lane_count; ++l) sum[l] += std::int64_t{weights[l]} * links[l];
  for (std::size_t l = 0; l < lane_count; ++l) sums[l] = sum[l];
}

HM_WIDEST void add_short_products(const std::int32_t* __restrict weights, std::size_t weight_stride,
                                  const std::int32_t* __restrict links, std::size_t link_stride,
                                  std::size_t taps, std::int64_t* __restrict sums) {
  std::int64_t sum[lane_count];
  for (std::size_t l = 0; l < lane_count; ++l) sum[l] = sums[l];
  for (std::size_t t = 0; t < taps; ++t, weights += weight_stride, links += link_stride)
    for (std::size_t l = 0; l < lane_count; ++l) sum[l] += std::int64_t{weights[l] * links[l]};
  for (std::size_t l = 0; l < lane_count; ++l) sums[l] = sum[l];
}

HM_WIDEST void add_magnitudes(const std::int32_t* __restrict weights, std::size_t stride, std::size_t taps,
                              int up, std::size_t rows, std::int64_t* __restrict norms) {
  for (std::size_t t = 0; t < taps; ++t)
    for (std::size_t r = 0; r < rows; ++r) {
      const std::int64_t w = weights[t * stride + r];
      norms[r] += (w < 0 ? -w : w) << up;
    }
}

HM_WIDEST void begin_sums(const std::int32_t* __restrict biases, int up, std::size_t rows,
                          std::int64_t* __restrict sums) {
  const std::int64_t by = std::int64_t{1} << up;
  for (std::size_t r = 0; r < rows; ++r) sums[r] = biases[r] * by;
}

HM_WIDEST void pull(const std::int64_t* __restrict drives, const std::int32_t* __restrict states,
                    std::int64_t one, const ShiftRounding& rounding, std::size_t rows,
                    std::int64_t* __restrict changes) {
  const ShiftRounding to_state = rounding;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::int64_t u = drives[r], V = states[r], R = u >= 0 ? one - V : one + V;
    changes[r] = rounded(R * u, to_state);
  }
}

HM_WIDEST std::int64_t add_changes(const std::int64_t* __restrict changes, const ShiftRounding& rounding,
                                   std::size_t rows, std::int32_t* __restrict states,
                                   std::int32_t* __restrict links) {
  const ShiftRounding to_link = rounding;
  std::int64_t largest = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::int64_t change = changes[r], V = states[r] + change, size = change < 0 ? -change : change;
    largest = size > largest ? size : largest;
    states[r] = static_cast<std::int32_t>(V);
    links[r] = static_cast<std::int32_t>(rounded(V, to_link));
  }
  return largest;
}

HM_WIDEST void step_from(const std::int64_t* __restrict drives, const std::int32_t* base,
                         const std::int32_t* states, std::int64_t one, const StepRounding& rounding,
                         std::size_t rows, std::int64_t* __restrict changes) {
  const ShiftRounding down = rounding.down;
  const std::int64_t up = std::int64_t{1} << rounding.up;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::int64_t next = base[r] + rounded(drives[r] * up, down);
    changes[r] = (next < -one ? -one : next > one ? one : next) - states[r];
  }
}

HM_WIDEST void add_changes_ahead(const std::int64_t* __restrict changes, const Momentum& stage,
                                 std::size_t rows, std::int32_t* __restrict states,
                                 std::int32_t* __restrict ahead, std::int32_t* __restrict links) {
  const Momentum by = stage;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::int64_t V = states[r] + changes[r], far = V + rounded(by.m * changes[r], by.gained);
    const std::int64_t Y = far < -by.one ? -by.one : far > by.one ? by.one : far;
    states[r] = static_cast<std::int32_t>(V);
    ahead[r] = static_cast<std::int32_t>(Y);
    links[r] = static_cast<std::int32_t>(rounded(Y, by.to_link));
  }
}

HM_WIDEST std::int64_t along(const std::int64_t* __restrict sums, const std::int64_t* __restrict changes,
                             std::size_t rows) {
  std::int64_t all = 0;
  for (std::size_t r = 0; r < rows; ++r) all += sums[r] > 0 ? changes[r] : sums[r] < 0 ? -changes[r] : 0;
  return all;
}

HM_WIDEST std::int64_t largest_moving(const std::int64_t* __restrict sums,
                                      const std::int32_t* __restrict base, std::int64_t at_one,
                                      std::int64_t at_minus_one, std::size_t rows) {
  std::int64_t largest = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const bool held = sums[r] >= 0 ? base[r] >= at_one : base[r] <= at_minus_one;
    const std::int64_t size = held ? 0 : sums[r] < 0 ? -sums[r] : sums[r];
    largest = size > largest ? size : largest;
  }
  return largest;
}

HM_WIDEST void show(const std::int32_t* __restrict states, const ShiftRounding& rounding, std::size_t rows,
                    std::int32_t* __restrict links) {
  const ShiftRounding to_link = rounding;
  for (std::size_t r = 0; r < rows; ++r)
    links[r] = static_cast<std::int32_t>(rounded(std::int64_t{states[r]}, to_link));
}

HM_WIDEST void copy_runs(const std::int32_t* __restrict links, const LinkRun* __restrict runs,
                         std::size_t count, std::size_t per_cell, std::size_t stride,
                         std::int32_t* __restrict inputs) {
  for (const LinkRun *run = runs, *const end = runs + count; run != end; ++run)
    for (std::uint32_t k = 0; k < run->count; k += lane_count) {
      const std::int32_t* from = links + run->row + k;
      std::int32_t* to = inputs + run->place + k;
      for (std::size_t l = 0; l < lane_count; ++l) to[l] = from[l];
      if (per_cell < 2) continue;
      from += run->width;
      to += stride;
      for (std::size_t l = 0; l < lane_count; ++l) to[l] = from[l];
      if (per_cell < 3) continue;
      from += run->width;
      to += stride;
      for (std::size_t l = 0; l < lane_count; ++l) to[l] = from[l];
    }
}

} // namespace hopmesh::engine
