// Kernels sum in 32 bits where every row allows it and in 64 elsewhere. Which of the two a run takes is seen
// by counting, on either side of the border; and rows of minima make sums that only 64 bits hold.
#include "tests/engine/engine_bench.h"

#include "rtl_model/spec/presets.h"
#include "sim/engine/kernels/fast_core.h"

namespace hopmesh::tests {
namespace {

using engine::Engine;
using engine::KernelSet;
using engine::Layout;
using engine::NeuronPlan;

// The kernels that `descent`-like arrays take ([3 neurons][multiply][not by sum][plain]), behind counters:
// function pointers carry no state, so that of the counters has to be static.
struct Counted {
  static inline const KernelSet* inner = nullptr;
  static inline int narrow = 0, wide = 0;
  static KernelSet kernels(const KernelSet& of) {
    inner = &of;
    narrow = wide = 0;
    KernelSet counted = of;
    counted.fire[2][0][0][1][0] = [](auto& a, auto first, auto last, auto& s) {
      ++narrow;
      inner->fire[2][0][0][1][0](a, first, last, s);
    };
    counted.fire[2][0][0][1][1] = [](auto& a, auto first, auto last, auto& s) {
      ++wide;
      inner->fire[2][0][0][1][1](a, first, last, s);
    };
    return counted;
  }
};

spec::ArraySpec counted_array() {
  spec::ArraySpec a = spec::default_array();
  a.formats.state = a.formats.link = {16, 2, spec::Rounding::rnd, spec::Overflow::sat};
  return a;
}

/// Two linked cells, all outputs at V; one row with these weights, all others empty.
ArrayJob one_row(const Codes& row, std::int32_t V) {
  const spec::Topology pair = topology_of(2, 3, {{0, 1}});
  ArrayJob job{counted_array(), pair, Codes(pair.weight_words(), 0), Codes(6, 0), Codes(6, V), 0, 1};
  std::copy(row.begin(), row.end(), job.weight.begin());
  return job;
}

/// V of the row's neuron after one sweep on these kernels.
std::int32_t sweep_once(const KernelSet& kernels, const ArrayJob& job) {
  const NeuronPlan plan(job.array, job.topology);
  const Layout layout(job.topology, spec::phases_of(job.topology, job.array.schedule), job.array.schedule);
  const auto core = engine::make_fast_core(plan, layout, kernels);
  core->put_weights(layout.slot_of_cell[0], 0, 0, job.weight.data(), 6);
  for (std::size_t k = 0; k < 6; ++k) core->put_state(layout.slot_of_cell[k / 3], k % 3, job.start[k]);
  core->prepare(0, layout.blocks());
  core->begin_run(false);
  engine::SweepRecord record;
  core->fire(0, layout.blocks(), {}, record);
  return core->state(layout.slot_of_cell[0], 0);
}

/// 131,071 * 16,384 = 2^31 - 16,384 fits 32 bits; one more unit of weight does not.
TEST(KernelSums, AreWideExactlyWhereARowAsksForIt) {
  const Codes most{-32768, -32768, -32768, -32767, 0, 0}, too_much{-32768, -32768, -32768, -32768, 0, 0},
      both_signs{-32768, 32767, -32768, 32767, 1, -1};
  for (const std::string& name : kernels_here())
    for (std::int32_t V : {16384, -16384}) {
      if (name == "generic") continue;
      SCOPED_TRACE(name + " from " + std::to_string(V));
      const KernelSet kernels = Counted::kernels(*engine::kernel_set(name));
      EXPECT_EQ(sweep_once(kernels, one_row(most, V)), run_slow_array(one_row(most, V)).output()[0]);
      EXPECT_EQ(Counted::narrow, 1);
      EXPECT_EQ(sweep_once(kernels, one_row(too_much, V)), run_slow_array(one_row(too_much, V)).output()[0]);
      EXPECT_EQ(Counted::wide, 1);
      EXPECT_EQ(sweep_once(kernels, one_row(both_signs, V)),
                run_slow_array(one_row(both_signs, V)).output()[0]);
      EXPECT_EQ(Counted::wide, 2);
    }
}

/// Every weight at the minimum and every output at one end: sums beyond 32 bits in either direction.
TEST(KernelSums, OfRowsOfMinimaNeedSixtyFourBits) {
  for (std::uint64_t seed = 950000; seed < 950036; ++seed) {
    Dice dice(seed);
    const spec::Topology topology = grid_topology(9, 8, true, seed % 2 ? 2 : 3);
    ArrayJob job;
    do {
      const auto normaliser = static_cast<spec::Normaliser>(seed / 2 % 3);
      job = random_codes(dice, random_fast_array(dice, topology, normaliser), topology);
    } while (job.array.formats.weight.width != 16 || job.array.formats.link.fraction_bits() != 14);
    std::fill(job.weight.begin(), job.weight.end(), -32768);
    std::fill(job.bias.begin(), job.bias.end(), 0);
    const auto one = static_cast<std::int32_t>(job.array.formats.state.one_raw());
    for (std::size_t k = 0; k < job.start.size(); ++k) job.start[k] = k < job.start.size() / 2 ? one : -one;
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job));
    const ArrayResult expected = run_slow_array(job);
    for (const std::string& kernel : kernels_here()) {
      Engine e(job.array, job.topology, {1, kernel, 1});
      expect_run(e, job, expected);
      EXPECT_LT(e.extremes().least_sum, INT32_MIN) << kernel;
      EXPECT_GT(e.extremes().largest_sum, INT32_MAX) << kernel;
    }
  }
}

} // namespace
} // namespace hopmesh::tests
