#include "tests/engine/engine_bench.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/engine/choose.h"
#include "sim/engine/kernels/fast_core.h"
#include "tests/support/slow_fixed.h"

#include <cstdio>

namespace hopmesh::tests {
namespace {

using engine::Engine;

const std::uint32_t* words(const Codes& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

spec::NumberFormat random_format(Dice& dice, int most_width, int least_integer_bits) {
  spec::NumberFormat f;
  f.width = static_cast<int>(dice.one_in(3) ? most_width : dice.between(4, most_width));
  const int most = dice.one_in(3) ? f.width - 1 : std::min(f.width - 1, least_integer_bits + 2);
  f.integer_bits = static_cast<int>(dice.between(least_integer_bits, most));
  f.rounding = dice.mode<spec::Rounding>(spec::rounding_names);
  f.overflow = dice.mode<spec::Overflow>(spec::overflow_names);
  return f;
}

std::vector<std::string> find_kernels() {
  std::vector<std::string> here;
  for (const std::string& name : engine::kernel_names()) {
    if (name == "auto") continue;
    if (name == "generic" || engine::kernel_set(name))
      here.push_back(name);
    else
      std::printf("left out: this processor has no kernel %s\n", name.c_str());
  }
  return here;
}

} // namespace

const std::vector<std::string>& kernels_here() {
  static const std::vector<std::string> here = find_kernels();
  return here;
}

std::string why_not_fast(const spec::ArraySpec& array, const spec::Topology& topology) {
  return engine::why_generic(engine::NeuronPlan(array, topology));
}

spec::ArraySpec random_fast_array(Dice& dice, const spec::Topology& topology, spec::Normaliser normaliser,
                                  spec::Output output) {
  spec::ArraySpec a;
  a.name = "random, for the kernels";
  a.normaliser = normaliser;
  a.output = output;
  do {
    a.schedule = dice.mode<spec::Schedule>(spec::schedule_names);
    a.lanes = static_cast<int>(dice.between(1, 6));
    a.reciprocal_bits = static_cast<int>(dice.between(4, 32));
    a.bus_bits = 32 << dice.below(3);
    a.relaxation = static_cast<int>(dice.between(1, 31));
    a.momentum_entries = static_cast<int>(dice.between(1, 6));
    a.formats.weight = random_format(dice, 16, 1);
    a.formats.link = random_format(dice, 16, 2);
    a.formats.bias = random_format(dice, 32, 1);
    a.formats.drive = random_format(dice, 32, 2);
    a.formats.state = random_format(dice, 32, 2);
  } while (spec::validate(a, topology.most_taps()) || !why_not_fast(a, topology).empty());
  return a;
}

void make_slim(Dice& dice, spec::ArraySpec& a) {
  for (spec::NumberFormat* f : {&a.formats.drive, &a.formats.state, &a.formats.link})
    f->rounding = dice.one_in(2) ? spec::Rounding::rnd : spec::Rounding::trn;
  a.reciprocal_bits = std::min(a.reciprocal_bits, 20);
}

void give_rule(Dice& dice, ArrayJob& job) {
  job.rule.by_sum = dice.one_in(2);
  job.rule.share = static_cast<int>(dice.below(6));
  if (dice.one_in(2)) job.rule.floor = dice.bits() >> dice.between(30, 63);
  job.momentum.clear();
  const bool falls = dice.one_in(2); // else outputs seldom move against their sums
  for (std::size_t k = 0; k < cosim::table_entries(job.array); ++k)
    job.momentum.push_back(
        static_cast<std::int32_t>(falls ? dice.code(spec::momentum_format) : dice.between(0, 32767)));
}

void load(Engine& e, const ArrayJob& job) {
  e.write_weights(0, words(job.weight), job.weight.size());
  e.write_biases(0, words(job.bias), job.bias.size());
  e.write_outputs(0, words(job.start), job.start.size());
  e.write_momentum(0, words(job.momentum), job.momentum.size());
}

Codes outputs(const Engine& e) {
  Codes codes(e.topology().neurons());
  e.read_outputs(0, reinterpret_cast<std::uint32_t*>(codes.data()), codes.size());
  return codes;
}

void expect_result(const Engine& e, const ArrayResult& expected) {
  const spec::Relaxation& r = e.result();
  EXPECT_EQ(outputs(e), expected.output());
  EXPECT_EQ(r.sweeps, expected.sweeps);
  EXPECT_EQ(r.converged, expected.converged);
  EXPECT_EQ(r.largest_change, expected.largest_change);
  EXPECT_EQ(r.largest_sum, expected.largest_sum);
  EXPECT_EQ(r.cycles, expected.cycles);
}

void expect_run(Engine& e, const ArrayJob& job, const ArrayResult& expected) {
  load(e, job);
  e.run(job.threshold, job.max_sweeps, job.rule);
  expect_result(e, expected);
}

std::string text(const engine::Options& options) {
  return "kernel " + options.kernel + ", threads " + std::to_string(options.threads) + ", followed " +
         std::to_string(options.followed);
}

std::vector<std::uint32_t> changes_of(const ArrayJob& job, const ArrayResult& result) {
  const spec::NumberFormat& f = job.array.formats.state;
  const std::int64_t one = f.one_raw();
  std::vector<std::int64_t> before;
  for (std::int32_t word : job.start)
    before.push_back(std::min(
        std::max<std::int64_t>(quantise_code(word, f.fraction_bits(),
                                             {f.width, f.integer_bits, f.rounding, spec::Overflow::wrap}),
                               -one),
        one));
  std::vector<std::uint32_t> changes;
  for (const Codes& after : result.history) {
    std::int64_t most = 0;
    for (std::size_t i = 0; i < after.size(); ++i) most = std::max(most, std::abs(after[i] - before[i]));
    changes.push_back(static_cast<std::uint32_t>(most));
    before.assign(after.begin(), after.end());
  }
  return changes;
}

} // namespace hopmesh::tests
