#include "sim/engine/rounding.h"

#include "rtl_model/spec/number_format.h"

namespace hopmesh::engine {

namespace {

struct ModeRule {
  spec::Rounding mode;
  RoundingRule rule;
};

using spec::Rounding;

// In the order of spec::Rounding.
constexpr ModeRule rules[] = {
    // mode                always: half, ones; below zero: unit, ones; odd
    {Rounding::rnd, {1, 0, 0, 0, 0}},          // nearest, a tie goes up
    {Rounding::rnd_zero, {1, -1, 0, 1, 0}},    // nearest, a tie goes toward zero
    {Rounding::rnd_min_inf, {1, -1, 0, 0, 0}}, // nearest, a tie goes down
    {Rounding::rnd_inf, {1, 0, 0, -1, 0}},     // nearest, a tie goes away from zero
    {Rounding::rnd_conv, {1, -1, 0, 0, 1}},    // nearest, a tie goes to the even number
    {Rounding::trn, {0, 0, 0, 0, 0}},          // down
    {Rounding::trn_zero, {0, 0, 1, -1, 0}},    // toward zero
};

constexpr bool in_order() {
  for (std::size_t k = 0; k < std::size(rules); ++k)
    if (rules[k].mode != static_cast<Rounding>(k)) return false;
  return std::size(rules) == spec::rounding_names.size();
}
static_assert(in_order());

} // namespace

RoundingRule rounding_rule(spec::Rounding mode) {
  return rules[static_cast<std::size_t>(mode)].rule;
}

} // namespace hopmesh::engine
