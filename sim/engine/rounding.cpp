#include "sim/engine/rounding.h"

#include "rtl_model/spec/number_format.h"

namespace hopmesh::engine {

namespace {

struct ModeRule {
  spec::Rounding mode;
  RoundingRule rule;
};

using spec::Rounding;

// In the order of spec::Rounding: half a unit, a unit if negative; ones, ones if negative, ones if odd.
constexpr ModeRule rules[] = {
    {Rounding::rnd, {true, false, 0, 0, 0}},          // nearest, a tie goes up
    {Rounding::rnd_zero, {true, false, -1, 1, 0}},    // nearest, a tie goes toward zero
    {Rounding::rnd_min_inf, {true, false, -1, 0, 0}}, // nearest, a tie goes down
    {Rounding::rnd_inf, {true, false, 0, -1, 0}},     // nearest, a tie goes away from zero
    {Rounding::rnd_conv, {true, false, -1, 0, 1}},    // nearest, a tie goes to the even number
    {Rounding::trn, {false, false, 0, 0, 0}},         // down
    {Rounding::trn_zero, {false, true, 0, -1, 0}},    // toward zero
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
