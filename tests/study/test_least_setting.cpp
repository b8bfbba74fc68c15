// The search for the least setting, on tests of its own making: monotone, with luck in it, out of reach.
#include "sim/study/size/least_setting.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace hopmesh::tests {
namespace {

using study::LeastSetting;
using study::Setting;
using study::Trial;

double cost_of(const Setting& s, const std::vector<double>& prices) {
  return std::inner_product(s.begin(), s.end(), prices.begin(), 0.0);
}

LeastSetting::Lowered not_below(int least) {
  return [least](const Setting& from, std::size_t knob, int by) -> std::optional<Setting> {
    Setting lower = from;
    lower[knob] -= by;
    return lower[knob] < least ? std::nullopt : std::optional(lower);
  };
}

/// Asks an error of one setting at a time; counts what is asked.
struct Asked {
  std::function<double(const Setting&)> error;
  double most;
  std::vector<double> prices;
  std::map<Setting, int> times;

  LeastSetting::Oracle oracle() {
    return [this](const std::vector<Setting>& settings) {
      std::vector<Trial> trials;
      for (const Setting& s : settings) {
        ++times[s];
        trials.push_back({error(s) <= most, error(s), cost_of(s, prices)});
      }
      return trials;
    };
  }
};

/// What the search promises of its end, whatever the test is like.
void expect_least(const LeastSetting& search, const LeastSetting::Lowered& lowered, const Setting& least,
                  const Asked& asked) {
  EXPECT_LE(asked.error(least), asked.most);
  for (std::size_t knob = 0; knob < least.size(); ++knob)
    for (int by : {1, 2})
      if (const auto less = lowered(least, knob, by)) {
        EXPECT_GT(asked.error(*less), asked.most) << "knob " << knob << " by " << by;
        EXPECT_TRUE(search.seen().count(*less)) << "no evidence for knob " << knob << " by " << by;
      }
  for (const auto& [setting, trial] : search.seen())
    EXPECT_FALSE(trial.passes && trial.cost < search.trial(least).cost) << "a cheaper one was seen to pass";
  for (const auto& [setting, count] : asked.times) EXPECT_EQ(count, 1);
}

// Each knob adds weight * 2^-bits. With one knob, by hand: 3 * 2^-b <= 0.01 from b = log2(300) = 8.2 on: 9.
TEST(LeastSetting, FindsTheOnlyKnobByHand) {
  Asked asked{[](const Setting& s) { return 3 * std::exp2(-s[0]); }, 0.01, {1}, {}};
  const auto lowered = not_below(1);
  LeastSetting search(1, lowered, asked.oracle());
  const auto least = search.from({30});
  ASSERT_TRUE(least);
  EXPECT_EQ(*least, Setting{9});
  expect_least(search, lowered, *least, asked);
}

// Two knobs of one weight, 2^-a + 2^-b <= 0.05: the cheapest are (5, 6), (6, 5) and, at prices 1 and 10, (7,
// 5).
TEST(LeastSetting, GivesTheDearKnobFewerBits) {
  Asked asked{[](const Setting& s) { return std::exp2(-s[0]) + std::exp2(-s[1]); }, 0.05, {1, 10}, {}};
  const auto lowered = not_below(1);
  LeastSetting search(2, lowered, asked.oracle());
  const auto least = search.from({24, 24});
  ASSERT_TRUE(least);
  EXPECT_EQ(*least, (Setting{6, 5})); // 2^-6 + 2^-5 = 0.047; (5, 5) has 0.0625, (6, 4) 0.078
  expect_least(search, lowered, *least, asked);
}

// (5, 4) is lost, (5, 3) passes by luck: one less fails, two less does not, and the search goes on from
// there.
TEST(LeastSetting, GoesOnFromWhatPassesByLuck) {
  Asked asked{[](const Setting& s) {
                if (s == Setting{5, 3}) return 0.01;
                return s[0] >= 5 && s[1] >= 5 ? 0.02 : 1.0;
              },
              0.05,
              {1, 1},
              {}};
  const auto lowered = not_below(1);
  LeastSetting search(2, lowered, asked.oracle());
  const auto least = search.from({20, 20});
  ASSERT_TRUE(least);
  EXPECT_EQ(*least, (Setting{5, 3}));
  expect_least(search, lowered, *least, asked);
}

// The start fails though less passes: chaos may have it so.
TEST(LeastSetting, LooksBelowAStartThatFails) {
  Asked asked{[](const Setting& s) { return s[0] > 15 || s[0] < 8 ? 1.0 : 0.0; }, 0.5, {1}, {}};
  LeastSetting search(1, not_below(1), asked.oracle());
  EXPECT_EQ(search.from({24}), std::optional(Setting{8}));
}

TEST(LeastSetting, SaysWhenNothingPasses) {
  Asked asked{[](const Setting&) { return 1.0; }, 0.5, {1, 1}, {}};
  LeastSetting search(2, not_below(1), asked.oracle());
  EXPECT_FALSE(search.from({24, 20}));
  EXPECT_FALSE(search.seen().empty());
}

TEST(LeastSetting, EndsAtTheLowestWhereEverythingPasses) {
  Asked asked{[](const Setting&) { return 0.0; }, 0.5, {1, 1}, {}};
  LeastSetting search(2, not_below(3), asked.oracle());
  EXPECT_EQ(search.from({24, 20}), std::optional(Setting{3, 3}));
}

// Rough errors of random weights: a setting's own noise, up to eight times either way.
TEST(LeastSetting, KeepsItsPromisesOnRoughTests) {
  const auto seed = std::random_device()();
  std::printf("seed %u\n", seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 50; ++round) {
    std::uniform_real_distribution<double> exponent(-3, 3), price(1, 30);
    std::vector<double> weights(5), prices(5);
    for (double& w : weights) w = std::exp2(exponent(random));
    for (double& p : prices) p = price(random);
    const std::uint64_t salt = random();
    Asked asked{[=](const Setting& s) {
                  double error = 0;
                  std::uint64_t hash = salt;
                  for (std::size_t k = 0; k < s.size(); ++k) {
                    error += weights[k] * std::exp2(-s[k]);
                    hash = (hash ^ static_cast<std::uint64_t>(s[k])) * 0x9E3779B97F4A7C15u,
                    hash ^= hash >> 29;
                  }
                  return error * std::exp2(static_cast<double>(hash % 61) / 10 - 3);
                },
                0.01,
                prices,
                {}};
    const auto lowered = not_below(1);
    LeastSetting search(5, lowered, asked.oracle());
    const auto least = search.from({24, 23, 30, 30, 24});
    ASSERT_TRUE(least) << "seed " << seed;
    expect_least(search, lowered, *least, asked);
    ASSERT_FALSE(HasFailure()) << "seed " << seed << ", round " << round;
  }
}

// A good guess spares everything wider, and a bad one costs a trial: the answer is no worse.
TEST(LeastSetting, beginsWhereItIsTold) {
  for (const int guess : {2, 9, 14, 30}) {
    const auto error = [](const Setting& s) { return std::exp2(-s[0]) + std::exp2(-s[1]); };
    Asked plain{error, 0.02, {1, 2}, {}}, told{error, 0.02, {1, 2}, {}};
    LeastSetting first(2, not_below(1), plain.oracle()), second(2, not_below(1), told.oracle());
    const auto least = first.from({30, 30}), again = second.from({30, 30}, guess);
    ASSERT_TRUE(least && again);
    EXPECT_LE(cost_of(*again, {1, 2}), cost_of(*least, {1, 2})) << guess;
    int widest = 0;
    for (const auto& [setting, times] : told.times) widest = std::max(widest, setting[0]);
    if (guess == 9 || guess == 14) {
      EXPECT_EQ(widest, guess);
    } else {
      EXPECT_EQ(widest, 30);
    }
  }
}

} // namespace
} // namespace hopmesh::tests
