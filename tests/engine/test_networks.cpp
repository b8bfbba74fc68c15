// Random networks on random arrays: the engine against the bit-serial array, raw code by raw code, on every
// core, with several threads and with sweeps that follow each other.
#include "sim/engine/engine.h"
#include "tests/support/random_network.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using engine::Engine;
using engine::Options;

const std::uint32_t* words(const std::vector<std::int32_t>& codes) {
  return reinterpret_cast<const std::uint32_t*>(codes.data());
}

void load(Engine& e, const ArrayJob& job) {
  e.write_weights(0, words(job.weight), job.weight.size());
  e.write_biases(0, words(job.bias), job.bias.size());
  e.write_outputs(0, words(job.start), job.start.size());
}

std::vector<std::int32_t> outputs(const Engine& e) {
  std::vector<std::int32_t> codes(e.topology().neurons());
  e.read_outputs(0, reinterpret_cast<std::uint32_t*>(codes.data()), codes.size());
  return codes;
}

void expect_run(Engine& e, const ArrayJob& job, const ArrayResult& expected) {
  load(e, job);
  const engine::RunResult r = e.run(job.threshold, job.max_sweeps);
  EXPECT_EQ(outputs(e), expected.output());
  EXPECT_EQ(r.sweeps, expected.sweeps);
  EXPECT_EQ(r.converged, expected.converged);
  EXPECT_EQ(r.largest_change, expected.largest_change);
  EXPECT_EQ(r.cycles, expected.cycles);
}

class EngineNetworks : public testing::TestWithParam<int> {};

TEST_P(EngineNetworks, EqualTheBitSerialArray) {
  constexpr int batch = 250;
  for (int k = 0; k < batch && !HasFailure(); ++k) {
    const std::uint64_t seed = 1 + static_cast<std::uint64_t>(GetParam()) * batch + k;
    const ArrayJob job = random_job(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job));
    const ArrayResult expected = run_slow_array(job);
    for (const Options& options : {Options{1, "auto", 1}, Options{1, "generic", 1}, Options{2, "auto", 1},
                                   Options{1, "auto", 3}, Options{2, "auto", 5}}) {
      Engine e(job.array, job.topology, options);
      expect_run(e, job, expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Batch, EngineNetworks, testing::Range(0, 8));

} // namespace
} // namespace hopmesh::tests
