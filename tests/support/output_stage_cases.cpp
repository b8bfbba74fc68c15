// The cases for output stages: corners by hand, the rest by dice.
#include "tests/support/output_stage_cases.h"

namespace hopmesh::tests {
namespace {

constexpr int most_bits_of_n = 40;

/// 0, the bounds, their neighbours, halves and walking ones, both signs.
std::vector<std::int64_t> state_corners(std::int64_t one) {
  std::vector<std::int64_t> corners{0};
  for (std::int64_t x : {one, one - 1, one / 2, one / 2 + 1, one / 3}) corners.insert(corners.end(), {x, -x});
  for (std::int64_t x = 1; x < one; x *= 2) corners.insert(corners.end(), {x, -x, one - x, x - one});
  return corners;
}

std::vector<std::int64_t> norm_corners() {
  std::vector<std::int64_t> corners{3, 5, 7, 1000003};
  for (int k = 0; k <= most_bits_of_n; ++k) {
    const std::int64_t power = std::int64_t{1} << k;
    for (std::int64_t x : {power - 1, power, power + 1})
      if (x > 0) corners.push_back(x);
  }
  return corners;
}

/// Zero, one unit, all of N, nearly all, half of it; and quotients that end in exactly one half of a last
/// place.
std::vector<std::int64_t> sum_corners(std::int64_t n, int drive_fraction) {
  std::vector<std::int64_t> corners{0};
  for (std::int64_t x : {std::int64_t{1}, n, n - 1, n / 2, (n + 1) / 2, n / 3})
    corners.insert(corners.end(), {x, -x});
  const std::int64_t halves = std::int64_t{2} << drive_fraction; // s / N = odd / halves is a tie
  if (n % halves == 0)
    for (std::int64_t odd : {std::int64_t{1}, std::int64_t{3}, halves / 2 - 1, halves - 1})
      corners.insert(corners.end(), {n / halves * odd, -(n / halves * odd)});
  return corners;
}

} // namespace

spec::ArraySpec stage_array(const spec::NumberFormat& stage) {
  spec::ArraySpec a;
  a.name = "output stage";
  a.normaliser = spec::Normaliser::divider;
  a.formats.weight = {8, 8 - stage_unit, spec::Rounding::rnd, spec::Overflow::sat};
  a.formats.bias = {12, 12 - stage_unit, spec::Rounding::rnd, spec::Overflow::sat};
  a.exact_accumulator = false;
  a.formats.accumulator = {48, 48 - stage_unit, spec::Rounding::trn, spec::Overflow::sat};
  a.formats.drive = a.formats.state = a.formats.link = stage;
  return a;
}

void StageJudge::complain(std::int64_t v, std::int64_t u, std::int64_t next, std::int64_t wanted,
                          bool mismatch, bool outside, bool wrong_way) {
  tally_.mismatches += mismatch;
  tally_.out_of_range += outside;
  tally_.wrong_direction += wrong_way;
  if (!tally_.first.empty()) return;
  const auto text = [](std::int64_t x) { return std::to_string(x); };
  tally_.first = "V " + text(v) + ", s " + text(s_) + ", N " + text(n_) + ": u " + text(u) + " (wanted " +
                 text(u_) + "), V' " + text(next) + " (wanted " + text(wanted) + "), " +
                 array_.formats.drive.text();
}

std::vector<StageCase> stage_corners(const spec::ArraySpec& array) {
  std::vector<StageCase> cases;
  for (std::int64_t n : norm_corners())
    for (std::int64_t s : sum_corners(n, array.formats.drive.fraction_bits()))
      for (std::int64_t v : state_corners(array.formats.state.one_raw())) cases.push_back({v, s, n});
  return cases;
}

StageCase random_stage_case(Dice& dice, const spec::ArraySpec& array) {
  const std::int64_t one = array.formats.state.one_raw();
  StageCase c;
  c.n = dice.between(1, std::int64_t{1} << dice.between(0, most_bits_of_n));
  c.s = dice.one_in(16) ? dice.between(-1, 1) * c.n : dice.between(-c.n, c.n);
  c.v = dice.one_in(16) ? dice.between(-1, 1) * one : dice.between(-one, one);
  return c;
}

} // namespace hopmesh::tests
