// Each module on a bench of its own: accumulator, output stage, sequencer, detector, link register.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "rtl_model/systemc/neuron.h"
#include "tests/support/dut.h"
#include "tests/support/random_network.h"
#include "tests/support/slow_neuron.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using spec::Normaliser;
using spec::Overflow;
using spec::Rounding;
using systemc::InputAccumulator;
using systemc::OutputStage;
using systemc::Sequencer;

// ---- InputAccumulator

/// A row on one accumulator: as a whole, beat by beat, and as the bit-serial neuron does it.
void expect_row(Dice& dice, const spec::ArraySpec& array, std::size_t sources, std::size_t per_source) {
  const std::size_t taps = sources * per_source;
  const spec::NumberFormat format = spec::accumulator_format(array, taps);
  const systemc::Datapath path(array, taps, per_source);
  InputAccumulator whole("whole", path, {taps}), beats("beats", path, {taps});
  const std::int64_t one = array.formats.link.one_raw();
  std::vector<std::vector<std::int32_t>> wires(sources, std::vector<std::int32_t>(per_source));
  std::vector<std::int64_t> weights, links;
  const auto bias = static_cast<std::int32_t>(dice.code(array.formats.bias));
  for (auto& source : wires)
    for (auto& wire : source) {
      links.push_back(wire = static_cast<std::int32_t>(dice.one_in(3) ? (dice.one_in(2) ? one : -one)
                                                                      : dice.between(-one, one)));
      weights.push_back(dice.code(array.formats.weight));
    }
  for (InputAccumulator* a : {&whole, &beats}) {
    a->set_bias(bias);
    for (std::size_t t = 0; t < taps; ++t) a->set_weight(t, static_cast<std::int32_t>(weights[t]));
    for (const auto& source : wires) a->connect(source.data());
  }
  ASSERT_EQ(beats.beats(), (taps + array.lanes - 1) / array.lanes);
  for (int pass = 0; pass < 2; ++pass) { // the second from what the first left behind
    whole.sum_row();
    whole.norm_row();
    beats.begin_sum();
    beats.begin_norm();
    for (std::size_t k = 0; k < beats.beats(); ++k) beats.sum_beat(k), beats.norm_beat(k);
    ASSERT_EQ(whole.sum_raw(), beats.sum_raw());
    ASSERT_EQ(whole.norm_raw(), beats.norm_raw());
    ASSERT_EQ(whole.sum_raw(), accumulate(array, format, weights, links, bias));
    ASSERT_EQ(static_cast<Wide>(whole.norm_raw()), row_sum(array, weights, bias));
  }
}

class Accumulator : public testing::TestWithParam<int> {};

TEST_P(Accumulator, RowAtOnceIsRowBeatByBeatInEveryMode) {
  std::uint64_t seed = 100 * static_cast<std::uint64_t>(GetParam());
  for (int rounding = 0; rounding < 7; ++rounding)
    for (int overflow = 0; overflow < 4; ++overflow)
      for (int width : {0, 9, 20, 62}) { // 0: exact; narrow ones overflow all the time
        spec::ArraySpec array = spec::guarded_array();
        array.lanes = GetParam();
        array.exact_accumulator = width == 0;
        array.formats.accumulator = {width ? width : 9, std::min(width ? width : 9, width == 62 ? 36 : 4),
                                     static_cast<Rounding>(rounding), static_cast<Overflow>(overflow)};
        for (std::size_t sources : {1u, 4u, 9u}) {
          Dice dice(++seed);
          SCOPED_TRACE("seed " + std::to_string(seed) + ", " + array.formats.accumulator.text());
          ASSERT_FALSE(spec::validate(array, 3 * sources));
          expect_row(dice, array, sources, 2 + seed % 2);
          if (HasFatalFailure()) return;
        }
      }
}

INSTANTIATE_TEST_SUITE_P(Lanes, Accumulator, testing::Values(1, 2, 3, 4, 7, 26, 27, 28, 64));

TEST(AccumulatorFormats, AnyValidArray) {
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Dice dice(seed);
    const std::size_t sources = 1 + dice.below(9), per_source = 2 + dice.below(2);
    const spec::ArraySpec array = random_array(dice, sources * per_source);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", lanes " + std::to_string(array.lanes));
    expect_row(dice, array, sources, per_source);
    if (HasFatalFailure()) return;
  }
}

// ---- OutputStage

spec::ArraySpec stage_spec(Normaliser normaliser, Rounding rounding) {
  spec::ArraySpec a = spec::descent_array();
  a.normaliser = normaliser;
  a.formats.drive.rounding = a.formats.state.rounding = rounding;
  return a;
}

/// V after one firing with this sum.
std::int64_t fired(OutputStage& stage, std::int64_t v, std::int64_t sum) {
  stage.load(static_cast<std::int32_t>(v));
  stage.normalise(sum);
  stage.find_change(stage.drive_raw());
  const std::int64_t moved = stage.publish();
  EXPECT_EQ(moved, stage.state_raw() - v);
  return stage.state_raw();
}

TEST(Stage, NoInputAtAllKeepsV) {
  for (auto normaliser : {Normaliser::divider, Normaliser::reciprocal})
    for (int rounding = 0; rounding < 7; ++rounding) {
      const auto a = stage_spec(normaliser, static_cast<Rounding>(rounding));
      const systemc::Datapath path(a, 3, 3);
      OutputStage stage("stage", path);
      for (std::int64_t n : {5, 0}) { // and an N of an earlier run is forgotten
        stage.set_norm(n);
        for (std::int64_t v : {-16384, -16383, -1, 0, 1, 16383, 16384}) {
          const std::int64_t after = fired(stage, v, 0);
          EXPECT_EQ(after, v);
          EXPECT_TRUE(n != 0 || stage.drive_raw() == 0);
        }
      }
    }
}

TEST(Stage, ABinaryOutputIsTheSignOfItsSumAndKeepsVAtZero) {
  for (int normaliser = 0; normaliser < 3; ++normaliser)
    for (int rounding = 0; rounding < 7; ++rounding) {
      auto a = stage_spec(static_cast<Normaliser>(normaliser), static_cast<Rounding>(rounding));
      a.output = spec::Output::binary;
      const systemc::Datapath path(a, 3, 3);
      OutputStage stage("stage", path); // no N was ever told
      for (std::int64_t v : {-16384, -16383, -1, 0, 1, 16383, 16384})
        for (std::int64_t size : {std::int64_t{1}, std::int64_t{16384}, std::int64_t{1} << 39}) {
          EXPECT_EQ(fired(stage, v, size), 16384);
          EXPECT_EQ(stage.drive_raw(), 16384);
          EXPECT_EQ(fired(stage, v, -size), -16384);
          EXPECT_EQ(fired(stage, v, 0), v);
          EXPECT_EQ(stage.drive_raw(), 0);
        }
    }
}

TEST(Stage, BoundsAreReachedAndNeverPassed) {
  for (int normaliser = 0; normaliser < 3; ++normaliser)
    for (int rounding = 0; rounding < 7; ++rounding) {
      const auto a = stage_spec(static_cast<Normaliser>(normaliser), static_cast<Rounding>(rounding));
      const systemc::Datapath path(a, 3, 3); // an exact accumulator of 29 fraction bits
      OutputStage stage("stage", path);
      const std::int64_t n = 32768, full = std::int64_t{1} << 29, one = 16384; // N = 1.0 of 15 fraction bits
      stage.set_norm(n);
      for (std::int64_t v : {-one, -one + 1, std::int64_t{0}, one - 1, one})
        for (std::int64_t sign : {-1, 1}) {
          const std::int64_t after = fired(stage, v, sign * full);
          EXPECT_LE(std::abs(after), one);
          EXPECT_EQ(after, sign * one) << v; // N is a power of two, its reciprocal exact
          const std::int64_t far = fired(stage, v, sign * 3 * full); // as a prescaled row rounded up
          EXPECT_TRUE(normaliser != 0 || far == sign * one) << v;
          EXPECT_LE(std::abs(stage.drive_raw()), one);
        }
    }
}

/// Truncated twice, the reciprocal never lets u pass s / N. Its mantissa is at least 2^(M - 2), so one part
/// in that is all it may lose, beside a last place of u.
TEST(Stage, TheReciprocalIsNeverTooLarge) {
  Dice dice(17);
  for (int bits : {4, 8, 18, 32}) {
    auto a = stage_spec(Normaliser::reciprocal, Rounding::trn_zero);
    a.reciprocal_bits = bits;
    const systemc::Datapath path(a, 27, 3);
    OutputStage stage("stage", path);
    double worst = 0;
    for (int k = 0; k < 20000; ++k) {
      const std::int64_t n = 1 + static_cast<std::int64_t>(dice.below(std::uint64_t{1} << dice.below(28)));
      const std::int64_t most = n << 14; // s counts 2^-29, N 2^-15
      const std::int64_t s = dice.one_in(4) ? (dice.one_in(2) ? most : -most) : dice.between(-most, most);
      stage.set_norm(n);
      stage.normalise(s);
      const __int128 u_n = static_cast<__int128>(stage.drive_raw()) * n; // u counts 2^-14: u N against s
      ASSERT_LE(u_n < 0 ? -u_n : u_n, std::abs(s)) << "s " << s << " N " << n;
      ASSERT_TRUE(stage.drive_raw() == 0 || (stage.drive_raw() < 0) == (s < 0));
      const double lost = static_cast<double>(std::abs(s)) / static_cast<double>(n) -
                          static_cast<double>(std::abs(stage.drive_raw()));
      worst = std::max(worst, lost);
      ASSERT_LT(lost, 1 + 16384 * std::ldexp(1.0, 2 - bits)) << "s " << s << " N " << n;
    }
    EXPECT_GT(worst, 0.5);
  }
}

// ---- ConvergenceDetector and LinkRegister

TEST(Detector, KeepsTheLargestOfASweep) {
  systemc::ConvergenceDetector d("d");
  for (std::int64_t change : {3, -7, 0, 5}) d.report(1, change, false);
  EXPECT_EQ(d.largest_change(), 7);
  EXPECT_EQ(d.largest_sum(), 0); // nobody asked
  d.begin_sweep();
  EXPECT_EQ(d.largest_change(), 0);
  d.report(-1, std::int64_t{1} << 31, false); // V from -1 to 1 in 32 bits
  EXPECT_EQ(d.largest_change(), std::int64_t{1} << 31);
}

TEST(Detector, KeepsTheLargestSumOfNeuronsThatMayMove) {
  systemc::ConvergenceDetector d("d");
  d.begin_run(true);
  d.begin_sweep();
  EXPECT_EQ(d.largest_sum(), 0);
  d.report(-9, -1, false);
  d.report(8, 1, false);
  d.report(100, 0, true); // held
  EXPECT_EQ(d.largest_sum(), 9);
  d.report(-(std::int64_t{1} << 61), 0, false); // the least code of the widest accumulator
  EXPECT_EQ(d.largest_sum(), std::int64_t{1} << 61);
  d.begin_sweep();
  EXPECT_EQ(d.largest_sum(), 0);
  d.begin_run(false);
  d.report(7, 1, false);
  EXPECT_EQ(d.largest_sum(), 0);
}

TEST(Detector, AddsWhatGoesWithTheSumsAndAgainstThem) {
  systemc::ConvergenceDetector d("d");
  d.report(5, 3, false);
  d.report(-1, -2, false);
  d.report(0, 100, false); // asked for nothing
  EXPECT_EQ(d.way(), 5);
  d.report(1, -4, true); // held ones count
  d.report(-1, 2, false);
  EXPECT_EQ(d.way(), -1);
  d.begin_sweep();
  EXPECT_EQ(d.way(), 0);
  for (int k = 0; k < 100; ++k) d.report(-1, std::int64_t{1} << 31, false);
  EXPECT_EQ(d.way(), -100 * (std::int64_t{1} << 31));
}

TEST(MomentumTable, TakesEntryAfterEntryAndHoldsTheLast) {
  systemc::MomentumTable none("none", 0), one("one", 1), three("three", 3);
  EXPECT_FALSE(none.exists());
  EXPECT_EQ(none.now(), 0);
  for (int k = 0; k < 3; ++k) three.set_code(static_cast<std::size_t>(k), 10 * (k + 1));
  const auto next = [&](bool restart) {
    three.end_sweep(restart);
    return three.now();
  };
  EXPECT_EQ(three.now(), 10);
  EXPECT_EQ(next(false), 20);
  EXPECT_EQ(next(false), 30);
  EXPECT_EQ(next(false), 30);
  EXPECT_EQ(next(true), 20); // the sweep that ends so counts as the first one
  EXPECT_EQ(next(true), 20);
  EXPECT_EQ(next(false), 30);
  three.begin_run();
  EXPECT_EQ(three.now(), 10);
  one.set_code(0, -5);
  for (bool restart : {false, true}) {
    one.end_sweep(restart);
    EXPECT_EQ(one.now(), -5);
  }
}

TEST(Link, ShowsWritesAfterTheUpdateAndLoadsAtOnce) {
  systemc::LinkRegister link("link");
  Dut::elaborate();
  const std::int32_t* wires = link.wires();
  link.load(2, 9);
  EXPECT_EQ(wires[2], 9);
  link.write(0, 5);
  link.write(1, 6);
  link.write(1, -6); // the last of a phase stays
  EXPECT_EQ((std::vector<std::int32_t>{wires[0], wires[1], wires[2]}), (std::vector<std::int32_t>{0, 0, 9}));
  sc_core::sc_start(sc_core::SC_ZERO_TIME);
  EXPECT_EQ((std::vector<std::int32_t>{wires[0], wires[1], wires[2]}), (std::vector<std::int32_t>{5, -6, 9}));
  EXPECT_EQ(link.wires(), wires); // who keeps the address keeps seeing
}

} // namespace
} // namespace hopmesh::tests
