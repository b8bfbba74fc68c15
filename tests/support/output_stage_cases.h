// Every case that an output stage is put through, whoever built it: all 8-bit states, and 16-bit corners
// before random ones (docs/method/verification.md). The judge is the bit-serial neuron.
#pragma once

#include "tests/support/random_network.h"
#include "tests/support/slow_neuron.h"

namespace hopmesh::tests {

/// What went wrong, how often; `first` tells the first case in words.
struct StageTally {
  std::uint64_t cases = 0, mismatches = 0, out_of_range = 0, wrong_direction = 0;
  std::string first;
};

/// s and N in one unit: an accumulator with the fraction bits of N, `stage` formats for drive and state.
spec::ArraySpec stage_array(const spec::NumberFormat& stage);

/// Weights and biases of stage_array() count in 2^-stage_unit, and so do s and N.
inline constexpr int stage_unit = 7;

/// V and s / N of one case.
struct StageCase {
  std::int64_t v, s, n;
};

class StageJudge {
 public:
  explicit StageJudge(const spec::ArraySpec& array) : array_(array) {}
  /// To be called before the cases of one (s, N).
  std::int64_t drive_for(std::int64_t s, std::int64_t n) {
    s_ = s, n_ = n;
    return u_ = drive(array_, array_.formats.accumulator, s, static_cast<Wide>(n));
  }
  /// A case: u and V' as the implementation under test has them.
  void judge(std::int64_t v, std::int64_t u, std::int64_t next) {
    tally_.cases += 1;
    const std::int64_t wanted = v + change(array_.formats, v, u_), one = array_.formats.state.one_raw();
    const bool mismatch = u != u_ || next != wanted, outside = next > one || next < -one;
    const bool wrong_way = (s_ > 0 && next < v) || (s_ < 0 && next > v) || (s_ == 0 && next != v);
    if (mismatch || outside || wrong_way) complain(v, u, next, wanted, mismatch, outside, wrong_way);
  }
  const StageTally& tally() const { return tally_; }

 private:
  void complain(std::int64_t v, std::int64_t u, std::int64_t next, std::int64_t wanted, bool mismatch,
                bool outside, bool wrong_way);

  const spec::ArraySpec array_;
  std::int64_t s_ = 0, n_ = 0, u_ = 0;
  StageTally tally_;
};

/// V in fixed<8,2> with |V| <= 1, N = 1 ... 1023, |s| <= N: 135,266,175 cases.
/// `normalise(s, n)` returns u and keeps it; `output(v)` returns V' for that u.
template <typename Normalise, typename Output>
StageTally run_all_8_bit_cases(const spec::ArraySpec& array, Normalise normalise, Output output) {
  StageJudge judge(array);
  const std::int64_t one = array.formats.state.one_raw();
  for (std::int64_t n = 1; n <= 1023; ++n)
    for (std::int64_t s = -n; s <= n; ++s) {
      judge.drive_for(s, n);
      const std::int64_t u = normalise(s, n);
      for (std::int64_t v = -one; v <= one; ++v) judge.judge(v, u, output(v));
    }
  return judge.tally();
}

/// Corners of V x corners of N and s; walking ones; ties of the division and of R u; in this order.
std::vector<StageCase> stage_corners(const spec::ArraySpec& array);
StageCase random_stage_case(Dice& dice, const spec::ArraySpec& array);

/// The corners, then random cases up to `cases`.
template <typename Normalise, typename Output>
StageTally run_corners_then_random(const spec::ArraySpec& array, std::uint64_t seed, std::uint64_t cases,
                                   Normalise normalise, Output output) {
  StageJudge judge(array);
  const auto run = [&](const StageCase& c) {
    judge.drive_for(c.s, c.n);
    const std::int64_t u = normalise(c.s, c.n);
    judge.judge(c.v, u, output(c.v));
  };
  for (const StageCase& c : stage_corners(array)) run(c);
  Dice dice(seed);
  while (judge.tally().cases < cases) run(random_stage_case(dice, array));
  return judge.tally();
}

} // namespace hopmesh::tests
