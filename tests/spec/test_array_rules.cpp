// Which arrays are refused, and with which sentence.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace hopmesh::tests {
namespace {

using namespace spec;

using Change = std::function<void(ArraySpec&)>;

/// The fault that a change of the `descent` array makes, as "key: found: expected"; empty if none.
std::string fault_of(const Change& change, std::size_t taps = 27) {
  ArraySpec array = descent_array();
  change(array);
  const auto fault = validate(array, taps);
  return fault ? fault->key + ": " + fault->found + ": " + fault->expected : "";
}

NumberFormat format(int width, int integer_bits) {
  return {width, integer_bits, Rounding::rnd, Overflow::sat};
}

TEST(ArrayRules, PresetsAreValidForTheLongestRowsOfAnySensibleMesh) {
  for (const ArraySpec& array : presets())
    for (std::size_t taps : {2, 3, 27, 39, 300}) {
      const auto fault = validate(array, taps);
      EXPECT_FALSE(fault) << array.name << ", " << taps << " taps: " << fault->key << " " << fault->expected;
    }
}

TEST(ArrayRules, PresetsAreFoundByTheirOwnNames) {
  for (const ArraySpec& array : presets()) {
    const auto found = preset(array.name);
    ASSERT_TRUE(found) << array.name;
    EXPECT_EQ(found->name, array.name);
  }
  EXPECT_FALSE(preset("no such array"));
  EXPECT_TRUE(preset(default_array().name));
}

TEST(ArrayRules, DescentMeetsTheConditionsOfItsProofs) {
  for (const ArraySpec& a : {descent_array(), descent_projected_array(), descent_momentum_array()}) {
    EXPECT_TRUE(a.exact_accumulator);
    EXPECT_EQ(a.formats.link, a.formats.state);
    EXPECT_EQ(a.formats.drive.rounding, Rounding::trn_zero);
    EXPECT_EQ(a.formats.state.rounding, Rounding::trn_zero);
    EXPECT_NE(a.normaliser, Normaliser::prescaled);
    EXPECT_EQ(a.schedule == Schedule::synchronous, a.output == Output::momentum);
  }
  EXPECT_EQ(descent_momentum_array().momentum_entries, 1); // the sequence begins with 0
}

TEST(ArrayRules, MomentumFiresAllAtOnceAndProjectedNever) {
  const auto fault = [](Output output, Schedule schedule) {
    return fault_of([&](ArraySpec& a) { a.output = output, a.schedule = schedule; });
  };
  const std::string all =
      ": \"synchronous\" with array.output = \"momentum\": momentum fires all neurons at once";
  EXPECT_EQ(fault(Output::momentum, Schedule::coloured), "array.schedule: \"coloured\"" + all);
  EXPECT_EQ(fault(Output::momentum, Schedule::sequential), "array.schedule: \"sequential\"" + all);
  EXPECT_EQ(fault(Output::momentum, Schedule::synchronous), "");
  EXPECT_EQ(fault(Output::projected, Schedule::synchronous),
            "array.schedule: \"synchronous\": \"coloured\" or \"sequential\" with array.output = "
            "\"projected\": neurons that share a weight fire in turn");
  EXPECT_EQ(fault(Output::projected, Schedule::coloured), "");
  EXPECT_EQ(fault(Output::projected, Schedule::sequential), "");
}

TEST(ArrayRules, StepsFurtherNeedANormaliserInTheCell) {
  for (const auto& [output, word] :
       {std::pair(Output::projected, "projected"), {Output::momentum, "momentum"}})
    for (auto normaliser : {Normaliser::prescaled, Normaliser::reciprocal, Normaliser::divider}) {
      const std::string fault = fault_of([&, o = output](ArraySpec& a) {
        a.output = o, a.normaliser = normaliser;
        if (o == Output::momentum) a.schedule = Schedule::synchronous;
      });
      EXPECT_EQ(fault,
                normaliser != Normaliser::prescaled
                    ? ""
                    : "array.normaliser: \"prescaled\": \"reciprocal\" or \"divider\" with array.output = "
                      "\"" +
                          std::string(word) + "\": prescaled rows are not symmetric");
    }
}

TEST(ArrayRules, StepsFurtherHaveBoundsOfTheirOwn) {
  for (int k : {0, 32})
    EXPECT_EQ(fault_of([k](ArraySpec& a) { a.relaxation = k; }),
              "array.relaxation: " + std::to_string(k) + ": 1 to 31");
  for (int k : {0, 4097})
    EXPECT_EQ(fault_of([k](ArraySpec& a) { a.momentum_entries = k; }),
              "array.momentum_entries: " + std::to_string(k) + ": 1 to 4096");
  const auto pipeline = [](ArraySpec a, int registers) {
    a.pipeline = registers;
    const auto fault = validate(a, 27);
    return fault ? fault->key + ": " + fault->found + ": " + fault->expected : "";
  };
  EXPECT_EQ(pipeline(descent_projected_array(), 2), "");
  EXPECT_EQ(pipeline(descent_projected_array(), 3), "array.pipeline: 3: 0 to 2 with projected outputs");
  EXPECT_EQ(pipeline(descent_momentum_array(), 3), "");
  EXPECT_EQ(pipeline(descent_momentum_array(), 4), "array.pipeline: 4: 0 to 3 with momentum outputs");
}

TEST(ArrayRules, WidthsAreFourToThirtyTwo) {
  const char* sentence = "4 to 32 bits";
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.weight = format(3, 1); }),
            std::string("formats.weight: fixed<3,1,SC_RND,SC_SAT>: ") + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.bias = format(33, 1); }),
            std::string("formats.bias: fixed<33,1,SC_RND,SC_SAT>: ") + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.drive = format(33, 2); }),
            std::string("formats.drive: fixed<33,2,SC_RND,SC_SAT>: ") + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.state = format(0, 2); }),
            std::string("formats.state: fixed<0,2,SC_RND,SC_SAT>: ") + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.link = format(3, 2); }),
            std::string("formats.link: fixed<3,2,SC_RND,SC_SAT>: ") + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.weight = format(4, 1); }), "");
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.weight = format(32, 1); }), "");
}

TEST(ArrayRules, PlusOneNeedsTwoIntegerBitsWhereVLives) {
  const std::string sentence = "from 2 integer bits to one less than the width (+1 needs two)";
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.drive = format(16, 1); }),
            "formats.drive: fixed<16,1,SC_RND,SC_SAT>: " + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.state = format(16, 1); }),
            "formats.state: fixed<16,1,SC_RND,SC_SAT>: " + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.link = format(16, 16); }),
            "formats.link: fixed<16,16,SC_RND,SC_SAT>: " + sentence);
}

TEST(ArrayRules, WeightsNeedASignBitAndAFraction) {
  const std::string sentence = "from 1 integer bits to one less than the width";
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.weight = format(16, 0); }),
            "formats.weight: fixed<16,0,SC_RND,SC_SAT>: " + sentence);
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.bias = format(16, 16); }),
            "formats.bias: fixed<16,16,SC_RND,SC_SAT>: " + sentence);
}

TEST(ArrayRules, LinksAreNoFinerThanTheState) {
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.formats.link = format(17, 2); }),
            "formats.link: fixed<17,2,SC_RND,SC_SAT>: at most the state's 14 fraction bits");
}

TEST(ArrayRules, ExactSumsFitSixtyTwoBits) {
  // weight fixed<32,1> times link fixed<32,2>: 31 + 30 fraction bits; a bias fixed<24,9> makes sums of up to
  // 27 + 256, which take ten.
  EXPECT_EQ(fault_of([](ArraySpec& a) {
              a.formats.weight = format(32, 1);
              a.formats.state = a.formats.link = format(32, 2);
            }),
            "formats.weight: fixed<32,1,SC_RND,SC_SAT>: formats whose exact sum fits 62 bits (this one needs "
            "71 for rows "
            "of 27 inputs)");
}

TEST(ArrayRules, OwnAccumulatorsLieBetweenFourAndSixtyTwoBits) {
  const auto own = [](const NumberFormat& f) {
    return fault_of([&](ArraySpec& a) {
      a.exact_accumulator = false;
      a.formats.accumulator = f;
    });
  };
  const std::string width = ": 4 to 62 bits, at least 1 of them before the point";
  EXPECT_EQ(own(format(63, 40)), "formats.accumulator: fixed<63,40,SC_RND,SC_SAT>" + width);
  EXPECT_EQ(own(format(3, 2)), "formats.accumulator: fixed<3,2,SC_RND,SC_SAT>" + width);
  EXPECT_EQ(own(format(20, 0)), "formats.accumulator: fixed<20,0,SC_RND,SC_SAT>" + width);
  EXPECT_EQ(own(format(20, 21)), "formats.accumulator: fixed<20,21,SC_RND,SC_SAT>" + width);
  EXPECT_EQ(own(format(20, 20)), "");
  // A product has 15 + 14 fraction bits.
  EXPECT_EQ(own(format(31, 2)), "");
  EXPECT_EQ(own(format(32, 2)),
            "formats.accumulator: fixed<32,2,SC_RND,SC_SAT>: at most the 29 fraction bits of a product");
}

/// Binary outputs look at no normaliser, so none is refused beside them.
TEST(ArrayRules, BinaryOutputsGoWithEveryPreset) {
  for (ArraySpec a : presets()) {
    a.output = Output::binary;
    EXPECT_FALSE(validate(a, 27)) << a.name;
    EXPECT_FALSE(sums_norm(a) || has_reciprocal(a)) << a.name;
  }
}

TEST(ArrayRules, ScalarsHaveBounds) {
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.lanes = 0; }), "array.lanes: 0: 1 to 64");
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.lanes = 65; }), "array.lanes: 65: 1 to 64");
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.reciprocal_bits = 3; }), "array.reciprocal_bits: 3: 4 to 32");
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.reciprocal_bits = 33; }), "array.reciprocal_bits: 33: 4 to 32");
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.bus_bits = 48; }), "array.bus_bits: 48: 32, 64 or 128");
  for (double mhz : {0.0, -1.0, 10001.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(fault_of([&](ArraySpec& a) { a.clock_mhz = mhz; }).find("above 0, at most 10000"),
              std::string::npos)
        << mhz;
  EXPECT_EQ(fault_of([](ArraySpec& a) { a.clock_mhz = 10000; }), "");
}

TEST(ArrayRules, ExactAccumulatorByHand) {
  // weight fixed<16,1> (F 15), link fixed<16,2> (F 14), bias fixed<24,9> (F 15): a sum lies within 27 + 256.
  const NumberFormat exact = exact_accumulator_format(descent_array().formats, 27);
  EXPECT_EQ(exact.fraction_bits(), 29);
  EXPECT_EQ(exact.integer_bits, 10);
  EXPECT_EQ(exact.width, 39);
  EXPECT_EQ(exact_accumulator_format(descent_array().formats, 3).integer_bits, 10);
  EXPECT_EQ(exact_accumulator_format(descent_array().formats, 255).integer_bits, 10); // 511
  EXPECT_EQ(exact_accumulator_format(descent_array().formats, 256).integer_bits,
            11); // 512 has no code in ten
  Formats fine_bias = descent_array().formats;
  fine_bias.bias = format(32, 1);
  fine_bias.link = fine_bias.state = format(8, 2);
  EXPECT_EQ(exact_accumulator_format(fine_bias, 3).fraction_bits(), 31); // finer than the product's 15 + 6
  EXPECT_EQ(exact_accumulator_format(fine_bias, 3).integer_bits, 4);     // 3 + 1
}

/// The width holds the largest sum there is, and one bit less would not.
TEST(ArrayRules, ExactAccumulatorIsTheLeastThatHoldsEverySum) {
  for (int weight_integer = 1; weight_integer < 20; ++weight_integer)
    for (int bias_integer = 1; bias_integer < 20; ++bias_integer)
      for (std::size_t taps : {1, 2, 3, 7, 8, 27, 81, 1000, 65535, 65536}) {
        Formats f = descent_array().formats;
        f.weight = format(20, weight_integer);
        f.bias = format(22, bias_integer);
        const NumberFormat exact = exact_accumulator_format(f, taps);
        // All weights and the bias at their least code, every V at -1 or +1: in last places of the sum.
        const double one = std::ldexp(1.0, exact.fraction_bits());
        const double largest = one * (static_cast<double>(taps) * std::ldexp(1.0, weight_integer - 1) +
                                      std::ldexp(1.0, bias_integer - 1));
        EXPECT_LT(largest, std::ldexp(1.0, exact.width - 1));
        EXPECT_GE(largest, std::ldexp(1.0, exact.width - 2));
      }
}

/// Cells of 1,023 links each, told by their number alone: 2^25 weights a pair of neurons.
TEST(ArrayRules, TheMapFitsThirtyTwoAddressBits) {
  Topology t;
  const std::uint32_t cells = 1 << 15;
  for (std::uint32_t c = 0; c <= cells; ++c) t.first_link.push_back(c * 1023);
  t.link_to.resize(std::size_t{cells} * 1023);
  ArraySpec a = guarded_array();
  t.neurons_per_cell = 3;
  EXPECT_EQ(t.weight_words(), std::size_t{9} << 25);
  EXPECT_EQ(memory_map(a, t).span, most_span); // a window of 2 GiB at 2 GiB
  EXPECT_FALSE(validate_on(a, t));
  t.neurons_per_cell = 5; // no such cell, but words enough: a window of 4 GiB at 4 GiB
  const auto fault = validate_on(a, t);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->key, "array.packing");
  EXPECT_EQ(fault->found, "8 GiB of registers and windows");
  a.packing = true;
  EXPECT_FALSE(validate_on(a, t));
}

/// Codes of half a word and less share words; where none can, the key has no effect.
TEST(ArrayRules, PackingCountsWhereSomethingCanBePacked) {
  const auto counts = [](const Change& change) {
    ArraySpec a = guarded_array();
    change(a);
    for (const ArrayKey& key : array_keys(a))
      if (key.name == "array.packing") return key.counts;
    return false;
  };
  EXPECT_TRUE(counts([](ArraySpec&) {}));
  EXPECT_FALSE(counts([](ArraySpec& a) { a.formats.weight = format(17, 1); }));
  EXPECT_TRUE(counts([](ArraySpec& a) {
    a.formats.weight = format(17, 1);
    a.formats.state = a.formats.link;
  }));
  EXPECT_TRUE(counts([](ArraySpec& a) {
    a.formats.weight = format(32, 1);
    a.formats.bias = format(16, 1);
  }));
  EXPECT_TRUE(counts([](ArraySpec& a) { // the table of m
    a.formats.weight = format(32, 1);
    a.output = Output::momentum;
  }));
}

} // namespace
} // namespace hopmesh::tests
