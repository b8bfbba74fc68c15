// A bit-serial neuron, written from docs/hardware/datapath.md alone: shift-add multiplication, restoring
// division.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "tests/support/slow_fixed.h"

namespace hopmesh::tests {

/// Product of two codes, one bit of the second at a time.
__int128 multiply(std::int64_t a, std::int64_t b);

/// The input accumulator s: `weight` and `link` are the taps in the row's order; `format` the register's.
std::int64_t accumulate(const spec::ArraySpec& array, const spec::NumberFormat& format,
                        const std::vector<std::int64_t>& weight, const std::vector<std::int64_t>& link,
                        std::int64_t bias);

/// N of a row, in units of 2^-max(F_weight, F_bias).
Wide row_sum(const spec::ArraySpec& array, const std::vector<std::int64_t>& weight, std::int64_t bias);

/// What divides s, in those units: N, with `momentum` without the bias, with `projected` the weight of the
/// tap that is the neuron itself.
Wide divisor(const spec::ArraySpec& array, const std::vector<std::int64_t>& weight, std::size_t own,
             std::int64_t bias);

/// u before the limiter, a code of the drive; with `projected` and `momentum` limited, since they round no
/// more than that.
std::int64_t unlimited_drive(const spec::ArraySpec& array, const spec::NumberFormat& accumulator,
                             std::int64_t s, Wide n);
/// r of a row sum above 0.
std::int64_t reciprocal_of(const spec::ArraySpec& array, Wide n);

/// u, limited; sign(s) where outputs are binary. `n` is the divisor; the prescaled normaliser does not look
/// at it.
std::int64_t drive(const spec::ArraySpec& array, const spec::NumberFormat& accumulator, std::int64_t s,
                   Wide n);

/// Delta V: R u rounded to the state's last place. Delta V may need one bit more than the state has (V from
/// -1 to 1), so the state's overflow mode has no say.
std::int64_t change(const spec::Formats& formats, std::int64_t v, std::int64_t u);

/// The output that `projected` (from V) and `momentum` (from Y) come to by u.
std::int64_t stepped(const spec::Formats& formats, std::int64_t from, std::int64_t u);

/// Y after a move of V to `after`, by m.
std::int64_t looked_ahead(const spec::Formats& formats, std::int64_t after, std::int64_t moved,
                          std::int64_t m);

/// L
std::int64_t link_code(const spec::Formats& formats, std::int64_t v);

} // namespace hopmesh::tests
