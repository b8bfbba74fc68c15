// Firings of one neuron: both models that can lay one open against the bit-serial neuron, number by number;
// the edges that lines are said to show; and that an array's edges are all there.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "sim/cosim/firings/edge_search.h"
#include "sim/cosim/firings/firing_edges.h"
#include "sim/cosim/firings/run_firings.h"
#include "tests/support/slow_array.h"
#include "tests/support/slow_neuron.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using namespace cosim;
using Longs = std::vector<std::int64_t>;

/// The neuron of slow_neuron.h, laid open.
class SlowOpenNeuron {
 public:
  SlowOpenNeuron(const spec::ArraySpec& array, std::size_t taps)
      : array_(array), accumulator_(spec::accumulator_format(array, taps)) {}

  spec::FiringSteps fire(const spec::FiringInputs& in) const {
    const Longs weight(in.weight.begin(), in.weight.end()), link(in.link.begin(), in.link.end());
    spec::FiringSteps s;
    s.sum = {accumulate(array_, accumulator_, {}, {}, in.bias)};
    for (std::size_t end = 0; end < weight.size();) {
      end = std::min(weight.size(), end + static_cast<std::size_t>(array_.lanes));
      s.sum.push_back(accumulate(array_, accumulator_, Longs(weight.begin(), weight.begin() + long(end)),
                                 Longs(link.begin(), link.begin() + long(end)), in.bias));
    }
    const bool summed =
        array_.output != spec::Output::binary && array_.normaliser != spec::Normaliser::prescaled;
    const Wide n = summed ? divisor(array_, weight, in.own_tap, in.bias) : 0;
    s.norm = static_cast<std::int64_t>(n);
    if (n != 0 && array_.normaliser == spec::Normaliser::reciprocal) invert(n, s);
    s.ratio = unlimited_drive(array_, accumulator_, s.sum.back(), n);
    s.drive = drive(array_, accumulator_, s.sum.back(), n);
    move(in, s);
    s.link = static_cast<std::int32_t>(
        link_code(array_.formats, array_.output == spec::Output::momentum ? s.extrapolated : s.state));
    return s;
  }

 private:
  void move(const spec::FiringInputs& in, spec::FiringSteps& s) const {
    const spec::Formats& f = array_.formats;
    const bool ahead = array_.output == spec::Output::momentum;
    if (ahead || array_.output == spec::Output::projected) {
      s.state = static_cast<std::int32_t>(stepped(f, ahead ? in.extrapolated : in.state, s.drive));
      s.change = std::int64_t{s.state} - in.state;
      if (!ahead) return;
      s.product = static_cast<std::int64_t>(multiply(s.change, in.momentum));
      s.extrapolated = static_cast<std::int32_t>(looked_ahead(f, s.state, s.change, in.momentum));
      return;
    }
    const std::int64_t one = std::int64_t{1} << f.state.fraction_bits();
    s.pull = s.drive >= 0 ? one - in.state : one + in.state;
    s.product = static_cast<std::int64_t>(multiply(s.pull, s.drive));
    s.change = change(f, in.state, s.drive);
    s.state = static_cast<std::int32_t>(in.state + s.change);
  }

  void invert(Wide n, spec::FiringSteps& s) const {
    int bits = 0;
    for (Wide x = n; x != 0; x >>= 1) ++bits;
    const int unit = std::max(array_.formats.weight.fraction_bits(), array_.formats.bias.fraction_bits());
    s.reciprocal = reciprocal_of(array_, n);
    s.places = bits + array_.reciprocal_bits - 2 + accumulator_.fraction_bits() - unit -
               array_.formats.drive.fraction_bits();
  }

  const spec::ArraySpec array_;
  const spec::NumberFormat accumulator_;
};

std::vector<std::string> open_level_names() {
  std::vector<std::string> names;
  for (const levels::Level& level : levels::levels())
    if (level.open_neuron) names.push_back(level.name);
  return names;
}

std::string text_of(const spec::FiringSteps& s) {
  std::string text;
  for (std::int64_t x : s.sum) text += std::to_string(x) + " ";
  for (std::int64_t x : {s.norm, s.reciprocal, s.places, s.ratio, s.drive, s.pull, s.product, s.change,
                         std::int64_t{s.state}, std::int64_t{s.extrapolated}, std::int64_t{s.link}})
    text += "| " + std::to_string(x) + " ";
  return text;
}

const std::uint32_t ties_of_output = bit_of(FiringEdge::drive_tie) | bit_of(FiringEdge::change_tie) |
                                     bit_of(FiringEdge::link_tie) | bit_of(FiringEdge::ahead_tie);

Cut slow_drive_cut(const NeuronShape& shape, const spec::FiringSteps& s) {
  const spec::Formats& f = shape.formats;
  const int unit = std::max(f.weight.fraction_bits(), f.bias.fraction_bits());
  const int up = f.drive.fraction_bits() + unit - f.accumulator.fraction_bits();
  const bool projected = shape.array.output == spec::Output::projected;
  const Wide omega = projected ? static_cast<Wide>(shape.array.relaxation) : 1;
  const int sixteenths = projected ? 4 : 0;
  const Wide sum = magnitude_of(s.sum.back()) * omega, norm = magnitude_of(s.norm) << sixteenths;
  if (shape.array.output == spec::Output::binary) return {};
  if (shape.array.normaliser == spec::Normaliser::prescaled)
    return cut_bits(sum, f.accumulator.fraction_bits(), f.drive.fraction_bits());
  if (norm == 0) return {};
  if (shape.array.normaliser == spec::Normaliser::divider)
    return cut_quotient(sum << std::max(up, 0), norm << std::max(-up, 0));
  return cut_bits(sum * magnitude_of(s.reciprocal), static_cast<int>(s.places) + sixteenths, 0);
}

/// Of the ties behind the accumulator, those that the slow oracle's cuts show.
std::uint32_t slow_ties(const NeuronShape& shape, const spec::FiringSteps& s) {
  const spec::Formats& f = shape.formats;
  const auto tie = [](const Cut& cut) { return cut.half && !cut.rest; };
  const auto bit = [](FiringEdge edge, bool shown) { return shown ? bit_of(edge) : 0; };
  const bool ahead = shape.array.output == spec::Output::momentum;
  const bool steps = ahead || shape.array.output == spec::Output::projected;
  const Cut change = steps ? cut_bits(magnitude_of(s.drive), f.drive.fraction_bits(), f.state.fraction_bits())
                           : cut_bits(magnitude_of(s.product), f.drive.fraction_bits(), 0);
  const Cut shown = cut_bits(magnitude_of(ahead ? s.extrapolated : s.state), f.state.fraction_bits(),
                             f.link.fraction_bits());
  return bit(FiringEdge::drive_tie, tie(slow_drive_cut(shape, s))) |
         bit(FiringEdge::change_tie, tie(change)) | bit(FiringEdge::link_tie, tie(shown)) |
         bit(FiringEdge::ahead_tie, ahead && tie(cut_bits(magnitude_of(s.product), 15, 0)));
}

/// Edges and random rows of an array: every model, number by number; returns the edges that were shown.
std::uint32_t expect_equal(const spec::ArraySpec& array, std::size_t taps, int random) {
  const NeuronShape shape(array, taps);
  const SlowOpenNeuron slow(array, taps);
  std::uint32_t shown = 0;
  for (const std::string& name : open_level_names()) {
    const auto neuron = levels::level_named(name, "").open_neuron(array, taps);
    std::vector<Firing> all = edge_firings(shape, neuron);
    Dice dice(taps);
    for (int k = 0; k < random; ++k) all.push_back(fired(shape, neuron, random_inputs(dice, shape, neuron)));
    for (const Firing& f : all) {
      const spec::FiringSteps right = slow.fire(f.inputs);
      EXPECT_EQ(text_of(f.steps), text_of(right)) << name;
      const std::uint32_t ties = slow_ties(shape, right);
      EXPECT_EQ(edge_names(f.edges & ties_of_output), edge_names(ties)) << name;
      shown |= f.edges;
    }
    if (testing::Test::HasFailure()) break;
  }
  return shown;
}

TEST(Firings, areThoseOfTheBitSerialNeuronOnRandomArrays) {
  for (std::uint64_t seed = 1; seed <= 60 && !testing::Test::HasFailure(); ++seed) {
    Dice dice(seed);
    const std::size_t taps = 1 + dice.below(dice.one_in(3) ? 60 : 9);
    SCOPED_TRACE("seed " + std::to_string(seed));
    const spec::ArraySpec array = random_array(dice, taps);
    expect_equal(array, taps, 100);
    expect_equal(stepping_array(dice, array, taps), taps, 100);
  }
}

/// All rounding and overflow modes, normalisers, with an accumulator that rounds.
TEST(Firings, areThoseOfTheBitSerialNeuronInEveryMode) {
  for (std::size_t q = 0; q < spec::rounding_names.size(); ++q)
    for (std::size_t o = 0; o < spec::overflow_names.size(); ++o)
      for (std::size_t n = 0; n < spec::normaliser_names.size(); ++n) {
        const auto rounding = static_cast<spec::Rounding>(q);
        const auto overflow = static_cast<spec::Overflow>(o);
        spec::ArraySpec a;
        a.normaliser = static_cast<spec::Normaliser>(n);
        a.lanes = 2;
        a.exact_accumulator = false;
        a.formats = {{8, 1, rounding, overflow}, {10, 3, rounding, overflow}, {12, 3, rounding, overflow},
                     {9, 2, rounding, overflow}, {10, 2, rounding, overflow}, {7, 2, rounding, overflow}};
        ASSERT_FALSE(spec::validate(a, 9));
        SCOPED_TRACE(std::string(spec::rounding_names[q]) + " " + std::string(spec::overflow_names[o]) + " " +
                     std::string(spec::normaliser_names[n]));
        const std::uint32_t shown = expect_equal(a, 9, 50);
        for (FiringEdge edge : {FiringEdge::sum_tie, FiringEdge::sum_overflow, FiringEdge::drive_tie,
                                FiringEdge::change_tie, FiringEdge::link_tie})
          EXPECT_TRUE(shown & bit_of(edge)) << edge_names(bit_of(edge));
        if (testing::Test::HasFailure()) return;
      }
}

TEST(Firings, showEveryEdgeThatAPresetCanHave) {
  const auto missing = [](const spec::ArraySpec& array, std::size_t taps) {
    const std::uint32_t all = (std::uint32_t{1} << firing_edges().size()) - 1;
    return edge_names(all & ~expect_equal(array, taps, 20));
  };
  const std::string beyond = "+held+ahead_tie+ahead_held"; // of stages beyond the paper's
  // Exact sums neither round nor overflow; |s| <= N, so the limiter never works.
  EXPECT_EQ(missing(spec::guarded_array(), 27), "sum_tie+sum_overflow+drive_overflow+limited" + beyond);
  // State and link are one format.
  EXPECT_EQ(missing(spec::descent_array(), 27),
            "sum_tie+sum_overflow+drive_overflow+limited+link_tie" + beyond);
  EXPECT_EQ(missing(spec::byte_array(), 9), "sum_tie+sum_overflow+drive_overflow+limited+link_tie" + beyond);
  // Nothing sums N; rows may be longer than N = 1 allows.
  EXPECT_EQ(missing(spec::prescaled_array(), 27), "norm_zero+sum_is_norm+sum_tie+sum_overflow" + beyond);
  spec::ArraySpec binary;
  binary.output = spec::Output::binary;
  EXPECT_EQ(missing(binary, 3),
            "norm_zero+sum_is_norm+sum_tie+sum_overflow+drive_tie+drive_overflow+limited+change_tie" +
                beyond);
}

TEST(Firings, showEveryEdgeThatTheStagesBeyondThePapersCanHave) {
  const auto missing = [](spec::ArraySpec array, spec::Output output) {
    array.output = output;
    if (output == spec::Output::momentum) array.schedule = spec::Schedule::synchronous;
    const std::uint32_t all = (std::uint32_t{1} << firing_edges().size()) - 1;
    return edge_names(all & ~expect_equal(array, 9, 20));
  };
  // u has fewer places than the state, so its step is exact.
  EXPECT_EQ(missing(spec::guarded_array(), spec::Output::projected),
            "sum_tie+sum_overflow+drive_overflow+change_tie+ahead_tie+ahead_held");
  EXPECT_EQ(missing(spec::guarded_array(), spec::Output::momentum),
            "sum_tie+sum_overflow+drive_overflow+change_tie");
  spec::ArraySpec coarse = spec::guarded_array();
  coarse.normaliser = spec::Normaliser::divider;
  coarse.formats.state = {14, 2, spec::Rounding::rnd_conv, spec::Overflow::wrap};
  coarse.formats.link = {12, 2, spec::Rounding::rnd_zero, spec::Overflow::wrap};
  EXPECT_EQ(missing(coarse, spec::Output::projected),
            "sum_tie+sum_overflow+drive_overflow+ahead_tie+ahead_held");
  EXPECT_EQ(missing(coarse, spec::Output::momentum), "sum_tie+sum_overflow+drive_overflow");
}

/// A firing by hand, in formats of eight bits: 1 is 64.
Firing by_hand(const NeuronShape& shape, spec::FiringInputs inputs) {
  static const auto neuron = levels::default_level().open_neuron(shape.array, shape.taps);
  return fired(shape, neuron, std::move(inputs));
}

TEST(Firings, areNumbersThatAHandCalculates) {
  const NeuronShape shape(spec::byte_array(), 3); // weight 2^-7, bias 2^-7, rounding of u and V toward zero
  // s = 64/128 * 32/64 = 1/4; N = 64/128 + 64/128; u = 1/4 = 16/64; R = 1 - 1/64; R u = 63 * 16 = 1008 /
  // 4096.
  const Firing f = by_hand(shape, {{0, 64, -64}, {1, 32, 0}, 0, 1});
  EXPECT_EQ(text_of(f.steps), "0 0 2048 2048 | 128 | 0 | 0 | 16 | 16 | 63 | 1008 | 15 | 16 | 0 | 16 ");
  EXPECT_EQ(edge_names(f.edges), "-");
  // u = 1/2, R = 63 / 64: half a last place is left.
  EXPECT_EQ(edge_names(by_hand(shape, {{0, 64, 0}, {1, 32, 0}, 0, 1}).edges), "change_tie");
  EXPECT_EQ(edge_names(by_hand(shape, {{0, 64, 0}, {64, -64, 0}, 0, 64}).edges), "sum_is_norm+state_high");
  EXPECT_EQ(edge_names(by_hand(shape, {{0, 0, 0}, {-64, 0, 0}, 0, -64}).edges),
            "norm_zero+sum_zero+state_low");
  // u = 1 / 128, half a last place of the drive: w = 1, L = 1 beside N = 2.
  EXPECT_EQ(edge_names(by_hand(shape, {{1, 1, 0}, {0, 1, 0}, 0, 0}).edges), "drive_tie");
}

class FiringsOfARun : public testing::TestWithParam<const char*> {};

TEST_P(FiringsOfARun, areThoseOfTheArray) {
  const ArrayJob job = random_job(21);
  const NeuronShape shape(job.array, job.topology.most_taps());
  const levels::Level& level = levels::level_named(GetParam(), "");
  const auto neuron = level.open_neuron(shape.array, shape.taps);
  const ArrayResult slow = run_slow_array(job);
  std::vector<std::int32_t> last(job.topology.neurons());
  std::size_t count = 0;
  EXPECT_TRUE(run_firings(job, shape, level, neuron, [&](const Firing& f) {
    last[f.neuron] = f.steps.state;
    EXPECT_EQ(f.sweep, 1 + count / job.topology.neurons());
    count += 1;
  }));
  EXPECT_EQ(count, slow.sweeps * job.topology.neurons());
  EXPECT_GT(count, 0u);
  EXPECT_EQ(last, slow.output());
}

INSTANTIATE_TEST_SUITE_P(On, FiringsOfARun, testing::Values("engine", "systemc", "systemc-clock"),
                         [](const auto& made) { return "Level" + std::to_string(made.index); });

TEST(FiringEdges, haveNamesThatReadBack) {
  for (std::uint32_t edges : {0u, 1u, 5u, 4095u}) EXPECT_EQ(edges_named(edge_names(edges)), edges);
  EXPECT_FALSE(edges_named("norm_zero+nothing"));
  EXPECT_FALSE(edges_named(""));
}

} // namespace
} // namespace hopmesh::tests
