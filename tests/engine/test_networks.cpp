// Random networks: the engine against the bit-serial array, raw code by raw code, with sweeps, the
// convergence bit, the largest change and the cycles. Any array on the cores that take it, and arrays made
// for the kernels on every kernel; each on several threads and with sweeps that follow each other.
#include "rtl_model/spec/presets.h"
#include "tests/engine/engine_bench.h"

#include <set>

namespace hopmesh::tests {
namespace {

using engine::Engine;
using engine::Options;

void run_all(const ArrayJob& job, std::uint64_t seed, const std::vector<Options>& ways) {
  SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job));
  const ArrayResult expected = run_slow_array(job);
  for (const Options& options : ways) {
    SCOPED_TRACE(text(options));
    Engine e(job.array, job.topology, options);
    expect_run(e, job, expected);
    expect_run(e, job, expected); // once more, with what the first run left behind
  }
}

/// Every kernel plainly, one of them on some threads, one with sweeps that follow each other.
std::vector<Options> ways_for(Dice& dice) {
  const auto& kernels = kernels_here();
  std::vector<Options> ways;
  for (const std::string& kernel : kernels) ways.push_back({1, kernel, 1});
  ways.push_back({static_cast<std::size_t>(dice.between(2, 3)), kernels[dice.below(kernels.size())], 1});
  ways.push_back({1, kernels[dice.below(kernels.size())], static_cast<std::size_t>(dice.between(2, 7))});
  return ways;
}

class EngineNetworks : public testing::TestWithParam<int> {};

TEST_P(EngineNetworks, OfAnyArray) {
  constexpr int batch = 500;
  for (int k = 0; k < batch && !HasFailure(); ++k) {
    const std::uint64_t seed = 1 + static_cast<std::uint64_t>(GetParam()) * batch + k;
    run_all(random_job(seed), seed,
            {{1, "auto", 1}, {1, "generic", 1}, {2, "auto", 1}, {1, "auto", 3}, {1, "generic", 2}});
  }
}

INSTANTIATE_TEST_SUITE_P(Batch, EngineNetworks, testing::Range(0, 4));

/// What random arrays came by, so that "every mode" is not only hoped for.
struct Coverage {
  std::set<std::string> seen;
  void note(const ArrayJob& job) {
    const spec::ArraySpec& a = job.array;
    const std::string normaliser(a.output == spec::Output::modified ? name_of(a.normaliser)
                                                                    : name_of(a.output)),
        per_cell = std::to_string(job.topology.neurons_per_cell);
    const auto note_modes = [&](const std::string& what, const spec::NumberFormat& f) {
      seen.insert(normaliser + " " + what + " " + std::string(name_of(f.rounding)));
      seen.insert(normaliser + " " + what + " " + std::string(name_of(f.overflow)));
    };
    note_modes("drive", a.formats.drive);
    note_modes("state", a.formats.state);
    note_modes("link", a.formats.link);
    seen.insert(normaliser + " " + std::string(name_of(a.schedule)) + " " + per_cell);
  }
  static std::size_t most(spec::Normaliser n, spec::Output output) {
    const std::size_t schedules = output == spec::Output::momentum    ? 1
                                  : output == spec::Output::projected ? 2
                                                                      : 3;
    const std::size_t all = 3 * (7 + 4) + schedules * 3;
    if (output == spec::Output::binary) return all;
    // Behind a divider the drive does not round to even; behind prescaled rows it saturates.
    return n == spec::Normaliser::divider ? all - 1 : n == spec::Normaliser::prescaled ? all - 2 : all;
  }
};

class KernelNetworks : public testing::TestWithParam<std::pair<spec::Output, spec::Normaliser>> {};

TEST_P(KernelNetworks, EqualTheBitSerialArrayInEveryMode) {
  const auto [output, normaliser] = GetParam();
  Coverage coverage;
  for (std::uint64_t k = 0; k < 700 && !HasFailure(); ++k) {
    const std::uint64_t seed =
        100000 + 10000 * (3 * static_cast<std::uint64_t>(output) + static_cast<std::uint64_t>(normaliser)) +
        k;
    Dice dice(seed);
    const spec::Topology topology = random_topology(dice, 70);
    spec::ArraySpec array = random_fast_array(dice, topology, normaliser, output);
    if (output == spec::Output::momentum && k % 2 == 0) make_slim(dice, array);
    ArrayJob job = random_codes(dice, array, topology);
    give_rule(dice, job);
    coverage.note(job);
    run_all(job, seed, ways_for(dice));
  }
  EXPECT_EQ(coverage.seen.size(), Coverage::most(normaliser, output));
}

using spec::Normaliser;
using spec::Output;

/// Binary outputs have no normaliser.
INSTANTIATE_TEST_SUITE_P(Normaliser, KernelNetworks,
                         testing::Values(std::pair{Output::modified, Normaliser::prescaled},
                                         std::pair{Output::modified, Normaliser::reciprocal},
                                         std::pair{Output::modified, Normaliser::divider},
                                         std::pair{Output::binary, Normaliser::prescaled},
                                         std::pair{Output::projected, Normaliser::reciprocal},
                                         std::pair{Output::projected, Normaliser::divider},
                                         std::pair{Output::momentum, Normaliser::reciprocal},
                                         std::pair{Output::momentum, Normaliser::divider}));

spec::Output output_of(std::uint64_t seed, Normaliser normaliser) {
  if (seed % 5 > 2 && normaliser != Normaliser::prescaled)
    return seed % 5 == 3 ? Output::projected : Output::momentum;
  return seed % 5 == 0 ? Output::binary : Output::modified;
}

/// Two cells with forty neighbours each, a bridge between them, empty rows, and cells that nobody knows.
spec::Topology stars(int per_cell) {
  Edges edges{{0, 50}};
  for (std::uint32_t k = 1; k <= 40; ++k) edges.insert(edges.end(), {{0, k}, {50, 50 + k}});
  return topology_of(97, per_cell, edges);
}

TEST(KernelStars, AndEmptyRowsAndLonelyCells) {
  for (std::uint64_t seed = 200000; seed < 200060; ++seed) {
    Dice dice(seed);
    const spec::Topology topology = stars(static_cast<int>(1 + seed % 3));
    const auto normaliser = static_cast<spec::Normaliser>(seed / 2 % 3);
    ArrayJob job = random_codes(
        dice, random_fast_array(dice, topology, normaliser, output_of(seed, normaliser)), topology);
    give_rule(dice, job);
    const auto last = static_cast<std::size_t>(topology.neurons_per_cell) - 1;
    for (std::size_t c = 0; c < topology.cells(); c += 3) { // no weight at all, and every other one no bias
      const std::size_t row = topology.row_offset(c, last);
      std::fill_n(job.weight.begin() + static_cast<std::ptrdiff_t>(row), topology.taps(c), 0);
      if (c % 2 == 0) job.bias[c * (last + 1) + last] = 0;
    }
    run_all(job, seed, ways_for(dice));
  }
}

/// 65,535 inputs of weight -1: the largest N that a kernel adds up.
TEST(KernelStars, AsLargeAsTheirSumsAllow) {
  constexpr std::uint32_t arms = 21844;
  Edges edges;
  for (std::uint32_t k = 1; k <= arms + 1; ++k) edges.push_back({0, k});
  spec::ArraySpec array = spec::descent_array();
  array.formats.bias = {16, 1, spec::Rounding::rnd, spec::Overflow::sat};
  EXPECT_EQ(why_not_fast(array, topology_of(arms + 2, 3, edges)), "rows of more than 65535 inputs");
  edges.pop_back();
  const spec::Topology topology = topology_of(arms + 1, 3, edges);
  ASSERT_EQ(topology.most_taps(), 65535u);
  ArrayJob job{array, topology, Codes(topology.weight_words(), -32768), Codes(topology.neurons(), 5),
               Codes(topology.neurons(), 16384)};
  std::fill_n(job.start.begin() + 30000, 30000, -16000);
  const ArrayResult expected = run_slow_array(job);
  for (const std::string& kernel : {std::string("portable"), kernels_here().back()}) {
    Engine e(array, topology, {1, kernel, 1});
    expect_run(e, job, expected);
  }
}

/// A graph without any order: neighbours come from everywhere.
spec::Topology tangle(Dice& dice, std::size_t cells, int per_cell) {
  Edges edges;
  for (std::size_t k = 0; k < 3 * cells; ++k) {
    const auto a = static_cast<std::uint32_t>(dice.below(cells)),
               b = static_cast<std::uint32_t>(dice.below(cells));
    if (a != b) edges.push_back({a, b});
  }
  return topology_of(cells, per_cell, edges);
}

/// Meshes larger than a few blocks, so that every way of finding neighbours is walked.
void run_large(std::uint64_t seed, spec::Topology topology, Dice& dice) {
  const auto normaliser = static_cast<spec::Normaliser>(seed % 3);
  ArrayJob job = random_codes(dice, random_fast_array(dice, topology, normaliser, output_of(seed)), topology);
  job.max_sweeps = 1 + static_cast<std::uint32_t>(seed % 4);
  run_all(job, seed, ways_for(dice));
}

TEST(KernelMeshes, TanglesOfUpToThreeThousandCells) {
  for (std::uint64_t seed = 300000; seed < 300024 && !testing::Test::HasFailure(); ++seed) {
    Dice dice(seed);
    const std::size_t cells = seed % 8 == 0 ? 3000 : static_cast<std::size_t>(dice.between(300, 1000));
    run_large(seed, tangle(dice, cells, static_cast<int>(1 + seed % 3)), dice);
  }
}

TEST(KernelMeshes, GridsOfTwentyToFortyRows) {
  for (std::uint64_t seed = 400000; seed < 400036 && !testing::Test::HasFailure(); ++seed) {
    Dice dice(seed);
    const auto rows = static_cast<std::size_t>(dice.between(20, 40)),
               columns = static_cast<std::size_t>(dice.between(5, 45));
    run_large(seed, grid_topology(rows, columns, dice.one_in(2), static_cast<int>(1 + seed % 3)), dice);
  }
}

} // namespace
} // namespace hopmesh::tests
