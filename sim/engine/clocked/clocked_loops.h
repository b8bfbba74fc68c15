// What the clock-stepped engine does in nearly every clock, as plain loops over rows side by side.
#pragma once

#include "sim/engine/clocked/clocked_layout.h"
#include "sim/engine/generic/lane_arithmetic.h"

namespace hopmesh::engine {

/// sums += weights * links: one tap of `rows` rows.
void add_tap(const std::int32_t* weights, const std::int32_t* links, std::size_t rows, std::int64_t* sums);
/// sums += weights * links over `taps` taps of lane_count rows; from one tap to the next it is a stride.
void add_products(const std::int32_t* weights, std::size_t weight_stride, const std::int32_t* links,
                  std::size_t link_stride, std::size_t taps, std::int64_t* sums);
// add_tap and add_products for codes whose product has at most 32 bits.
void add_short_tap(const std::int32_t* weights, const std::int32_t* links, std::size_t rows,
                   std::int64_t* sums);
void add_short_products(const std::int32_t* weights, std::size_t weight_stride, const std::int32_t* links,
                        std::size_t link_stride, std::size_t taps, std::int64_t* sums);
/// norms += |weights| * 2^up.
void add_magnitudes(const std::int32_t* weights, std::size_t stride, std::size_t taps, int up,
                    std::size_t rows, std::int64_t* norms);
/// sums <- biases * 2^up.
void begin_sums(const std::int32_t* biases, int up, std::size_t rows, std::int64_t* sums);
/// changes <- Q[R u].
void pull(const std::int64_t* drives, const std::int32_t* states, std::int64_t one,
          const ShiftRounding& rounding, std::size_t rows, std::int64_t* changes);
/// changes <- V' - V, where V' is a step of u away from `base`, held within ±one: V itself, or Y.
void step_from(const std::int64_t* drives, const std::int32_t* base, const std::int32_t* states,
               std::int64_t one, const StepRounding& rounding, std::size_t rows, std::int64_t* changes);
/// V <- V + Delta V; Y <- V + m Delta V, held within ±one, and the links of that.
void add_changes_ahead(const std::int64_t* changes, const Momentum& stage, std::size_t rows,
                       std::int32_t* states, std::int32_t* ahead, std::int32_t* links);
/// The sum of sign(s) Delta V.
std::int64_t along(const std::int64_t* sums, const std::int64_t* changes, std::size_t rows);
/// The largest |s| of rows that may still move: links do not show `base`, from where they move, at the bound
/// that s pushes to. `at_one`, `at_minus_one`: from there on they do.
std::int64_t largest_moving(const std::int64_t* sums, const std::int32_t* base, std::int64_t at_one,
                            std::int64_t at_minus_one, std::size_t rows);
/// links <- as neighbours see these states.
void show(const std::int32_t* states, const ShiftRounding& to_link, std::size_t rows, std::int32_t* links);
/// V <- V + Delta V, and its links; returns the largest |Delta V|.
std::int64_t add_changes(const std::int64_t* changes, const ShiftRounding& to_link, std::size_t rows,
                         std::int32_t* states, std::int32_t* links);
/// inputs[p * stride + place ...] <- the links of neuron p in the rows that `runs` name. Reads and writes up
/// to lane_count places beyond the end of every run, so runs must come in the order of their places, and a
/// stride must leave room.
void copy_runs(const std::int32_t* links, const LinkRun* runs, std::size_t count, std::size_t per_cell,
               std::size_t stride, std::int32_t* inputs);

} // namespace hopmesh::engine
