// Weights that kernels keep once, where they are symmetric and equal in both directions: every bit as the
// bit-serial array has it, and as soon as one code differs, every bit again.
#include "rtl_model/spec/presets.h"
#include "tests/engine/engine_bench.h"

namespace hopmesh::tests {
namespace {

using engine::Engine;
using engine::Options;

/// Makes W[j][q][i][p] of W[i][p][j][q].
void mirror(ArrayJob& job) {
  const spec::Topology& t = job.topology;
  const auto n = static_cast<std::size_t>(t.neurons_per_cell);
  const auto pair = [&](std::size_t i, std::size_t j) {
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = 0; q < n; ++q) {
        const std::int32_t code = job.weight[weight_word(t, i, std::min(p, q), j, std::max(p, q))];
        job.weight[weight_word(t, i, p, j, q)] = job.weight[weight_word(t, j, q, i, p)] = code;
      }
  };
  for (std::size_t i = 0; i < t.cells(); ++i) {
    pair(i, i);
    for (std::size_t k = t.first_link[i]; k < t.first_link[i + 1]; ++k)
      if (t.link_to[k] > i) pair(i, t.link_to[k]);
  }
}

/// Grids of any shape, with and without diagonals.
spec::Topology random_grid(Dice& dice) {
  const auto rows = static_cast<std::size_t>(dice.between(2, 14)),
             columns = static_cast<std::size_t>(dice.between(3, 30));
  return grid_topology(rows, columns, dice.one_in(2), static_cast<int>(dice.between(1, 3)));
}

/// Momentum, with sums that 32 bits hold.
ArrayJob random_symmetric_job(Dice& dice, const spec::Topology& topology) {
  spec::ArraySpec array = spec::default_array();
  if (dice.one_in(2))
    array = random_fast_array(dice, topology,
                              dice.one_in(2) ? spec::Normaliser::reciprocal : spec::Normaliser::divider,
                              spec::Output::momentum);
  array.output = spec::Output::momentum;
  array.schedule = spec::Schedule::synchronous;
  array.momentum_entries = 5;
  make_slim(dice, array);
  ArrayJob job = random_codes(dice, array, topology);
  const auto down = dice.between(4, 8);
  for (std::int32_t& code : job.weight) code >>= down;
  for (std::int32_t& code : job.bias) code >>= 8 + down;
  mirror(job);
  give_rule(dice, job);
  return job;
}

void write_weight(Engine& e, ArrayJob& job, std::size_t at, std::int32_t code) {
  job.weight[at] = code;
  const auto word = static_cast<std::uint32_t>(code);
  e.write_weights(at, &word, 1);
}

void run_again(Engine& e, const ArrayJob& job) {
  e.write_outputs(0, reinterpret_cast<const std::uint32_t*>(job.start.data()), job.start.size());
  e.run(job.threshold, job.max_sweeps, job.rule);
  expect_result(e, run_slow_array(job));
}

/// A word off the diagonal of the whole matrix.
std::size_t word_of_two(Dice& dice, const spec::Topology& t) {
  while (true) {
    const auto i = static_cast<std::size_t>(dice.below(t.cells()));
    if (t.degree(i) == 0) continue;
    const auto n = static_cast<std::size_t>(t.neurons_per_cell);
    const std::size_t j = t.link_to[t.first_link[i] + dice.below(t.degree(i))];
    return weight_word(t, i, dice.below(n), dice.one_in(3) && n > 1 ? i : j, 0) +
           (dice.one_in(2) ? n - 1 : 0);
  }
}

/// Runs a job, then with a code that makes it asymmetric, then with that code as it was. Returns whether a
/// sweep of the first moved fewer bytes than one of the second.
bool run_around(Engine& e, ArrayJob job, Dice& dice) {
  expect_run(e, job, run_slow_array(job));
  const std::size_t symmetric = e.bytes_per_sweep();
  const std::size_t at = word_of_two(dice, job.topology);
  const std::int32_t code = job.weight[at];
  write_weight(e, job, at, code ^ 1);
  run_again(e, job);
  const std::size_t asymmetric = e.bytes_per_sweep();
  write_weight(e, job, at, code);
  run_again(e, job);
  EXPECT_EQ(e.bytes_per_sweep(), symmetric);
  return symmetric < asymmetric;
}

TEST(OnceWeights, EqualTheBitSerialArrayBeforeAndAfterACodeDiffers) {
  const std::vector<std::string>& kernels = kernels_here();
  std::size_t once = 0, all = 0;
  for (std::uint64_t seed = 500000; seed < 500060 && !HasFailure(); ++seed) {
    Dice dice(seed);
    const ArrayJob job = random_symmetric_job(dice, random_grid(dice));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job));
    for (const Options& options : {Options{1, kernels[dice.below(kernels.size())], 1},
                                   Options{static_cast<std::size_t>(dice.between(1, 3)), "auto", 1},
                                   Options{static_cast<std::size_t>(dice.between(1, 2)), "auto", 3}}) {
      SCOPED_TRACE(text(options));
      Engine e(job.array, job.topology, options);
      once += run_around(e, job, dice);
      all += 1;
    }
  }
  if (kernels.back() != "portable") {
    EXPECT_GT(4 * once, all);
  }
}

/// What is asked of momentum: at most 66 bytes an update, from 400 nodes on.
TEST(OnceWeights, MoveFewBytes) {
  if (kernels_here().back() == "portable") GTEST_SKIP() << "this processor has no kernel for them";
  for (std::size_t rows : {20u, 40u, 100u}) {
    const spec::Topology topology = grid_topology(rows, rows - 1, true);
    spec::ArraySpec array = spec::default_array();
    array.output = spec::Output::momentum;
    array.schedule = spec::Schedule::synchronous;
    Engine e(array, topology);
    e.run(0, 1);
    EXPECT_LT(e.bytes_per_sweep(), 66 * topology.neurons()) << rows;
  }
}

} // namespace
} // namespace hopmesh::tests
