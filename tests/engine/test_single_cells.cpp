// Networks that are no mesh: cells of one neuron, rows of any length. Hubs, full graphs, rows of nothing;
// every core and way of sweeping against the bit-serial array, raw code by raw code.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "tests/engine/engine_bench.h"

namespace hopmesh::tests {
namespace {

using engine::Engine;
using engine::Options;

void expect_everywhere(const ArrayJob& job) {
  SCOPED_TRACE(describe(job));
  const ArrayResult expected = run_slow_array(job);
  std::vector<Options> ways{{2, "auto", 1}, {1, "auto", 3}};
  for (const std::string& kernel : kernels_here()) ways.push_back({1, kernel, 1});
  for (const Options& options : ways) {
    SCOPED_TRACE(text(options));
    Engine e(job.array, job.topology, options);
    expect_run(e, job, expected);
  }
}

/// Each output, every schedule.
void expect_in_every_schedule(Dice& dice, const spec::Topology& topology, std::uint32_t sweeps) {
  for (auto output : {spec::Output::modified, spec::Output::binary})
    for (int schedule = 0; schedule < 3; ++schedule) {
      spec::ArraySpec array = spec::default_array();
      array.output = output;
      array.schedule = static_cast<spec::Schedule>(schedule);
      ArrayJob job = random_codes(dice, array, topology);
      job.threshold = 0, job.max_sweeps = sweeps;
      expect_everywhere(job);
    }
}

/// Rows of one tap to 2,501, beside rows that weigh nothing and have no bias.
TEST(SingleCells, HubsAmongShortRows) {
  Dice dice(1);
  Edges edges;
  for (std::uint32_t k = 0; k < 2500; ++k) edges.push_back({0, 100 + k});
  for (std::uint32_t k = 0; k < 300; ++k) edges.push_back({1 + k / 10, 50 + 7 * k % 2500});
  const spec::Topology topology = topology_of(2700, 1, edges);
  ASSERT_GE(topology.most_taps(), 2501u);
  ASSERT_EQ(topology.taps(2699), 1u);
  for (auto output : {spec::Output::modified, spec::Output::binary}) {
    spec::ArraySpec array = spec::default_array();
    array.output = output;
    ArrayJob job = random_codes(dice, array, topology);
    for (std::size_t c = 0; c < topology.cells(); c += 3) {
      std::fill_n(job.weight.begin() + static_cast<std::ptrdiff_t>(topology.row_offset(c, 0)),
                  topology.taps(c), 0);
      job.bias[c] = 0;
    }
    job.threshold = 0, job.max_sweeps = 2;
    expect_everywhere(job);
    const Codes rest = run_slow_array(job).output();
    for (std::size_t c = 0; c < topology.cells(); c += 3) // nothing moves them
      ASSERT_EQ(rest[c], std::min(std::max(job.start[c], -(1 << 22)), 1 << 22));
  }
}

TEST(SingleCells, EveryNeuronKnowsEveryOther) {
  Dice dice(2);
  Edges edges;
  for (std::uint32_t a = 0; a < 90; ++a)
    for (std::uint32_t b = 0; b < a; ++b) edges.push_back({a, b});
  const spec::Topology full = topology_of(90, 1, edges);
  EXPECT_EQ(spec::phases_of(full, spec::Schedule::coloured).size(), 90u);
  expect_in_every_schedule(dice, full, 3);
}

TEST(SingleCells, TanglesAndGrids) {
  Dice dice(3);
  Edges edges;
  for (int k = 0; k < 2400; ++k) {
    const auto a = static_cast<std::uint32_t>(dice.below(800)),
               b = static_cast<std::uint32_t>(dice.below(800));
    if (a != b) edges.push_back({a, b});
  }
  expect_in_every_schedule(dice, topology_of(800, 1, edges), 4);
  expect_in_every_schedule(dice, grid_topology(23, 31, true, 1), 4);
}

/// The largest associative memory of the paper's kind that is asked for: 1,000 neurons, 999,000 links.
/// Weights that a host would load, and one sweep in every order, against sums formed here.
TEST(SingleCells, AThousandNeuronsThatAllKnowEachOther) {
  constexpr std::size_t n = 1000;
  spec::Topology full;
  full.neurons_per_cell = 1;
  for (std::uint32_t a = 0; a < n; ++a) {
    full.first_link.push_back(static_cast<std::uint32_t>(a * (n - 1)));
    for (std::uint32_t b = 0; b < n; ++b)
      if (b != a) full.link_to.push_back(b);
  }
  full.first_link.push_back(n * (n - 1));
  Dice dice(4);
  spec::ArraySpec array = spec::default_array();
  array.output = spec::Output::binary;
  ASSERT_FALSE(spec::validate(array, full.most_taps()));
  ArrayJob job{array, full, Codes(n * n), Codes(n, 0), Codes(n), 0, 1};
  for (std::int32_t& w : job.weight) w = static_cast<std::int32_t>(dice.between(-100, 100));
  for (std::int32_t& V : job.start) V = dice.one_in(2) ? 1 << 22 : -(1 << 22);
  std::vector<std::int64_t> V(job.start.begin(), job.start.end());
  for (std::size_t a = 0; a < n; ++a) { // one at a time, in the order of numbers
    std::int64_t s = job.weight[a * n] * V[a];
    for (std::size_t tap = 1; tap < n; ++tap) s += job.weight[a * n + tap] * V[tap <= a ? tap - 1 : tap];
    if (s != 0) V[a] = s > 0 ? 1 << 22 : -(1 << 22);
  }
  job.array.schedule = spec::Schedule::sequential;
  for (const std::string& kernel : kernels_here()) {
    Engine e(job.array, full, {1, kernel, 1});
    load(e, job);
    EXPECT_EQ(e.run(0, 1).cycles, 1u + n * (n + 2) + 1) << kernel;
    EXPECT_EQ(outputs(e), Codes(V.begin(), V.end())) << kernel;
  }
}

} // namespace
} // namespace hopmesh::tests
