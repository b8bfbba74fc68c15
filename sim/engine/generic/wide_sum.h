// The register of a rounding accumulator, of one row, in 128 bits: for any format there may be.
#pragma once

#include "sim/engine/neuron_plan.h"
#include "sim/engine/overflow.h"
#include "sim/engine/rounding.h"

namespace hopmesh::engine {

class WideSum {
 public:
  explicit WideSum(const NeuronPlan& plan)
      : product_up_(plan.product_up), format_(plan.formats.accumulator),
        bias_(shift_rounding<Int128>(plan.bias_down, plan.formats.accumulator.rounding)),
        sum_(shift_rounding<Int128>(plan.sum_up, plan.formats.accumulator.rounding)) {}

  /// s as the bias leaves it.
  std::int64_t begin(std::int32_t bias) const { return limited(rounded(bias, bias_), format_); }
  /// s after one beat more.
  std::int64_t add(std::int64_t sum, std::int64_t products) const {
    const Int128 fine = shifted_up<Int128>(sum, sum_.places) + shifted_up<Int128>(products, product_up_);
    return limited(rounded(fine, sum_), format_);
  }

 private:
  int product_up_;
  Limit format_;
  WideShiftRounding bias_, sum_;
};

} // namespace hopmesh::engine
