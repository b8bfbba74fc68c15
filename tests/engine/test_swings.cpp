// The swings of s and u that a study reads: equal between the SystemC array and every core.
#include "tests/engine/engine_bench.h"
#include "tests/support/dut_job.h"

namespace hopmesh::tests {
namespace {

struct Bench {
  Bench(std::uint64_t seed_of_job, const ArrayJob& a_job)
      : seed(seed_of_job), job(a_job), dut(("dut" + std::to_string(seed)).c_str(), job.array, job.topology) {}
  void run_systemc() {
    load(dut, job);
    dut.start(job.threshold, job.max_sweeps);
    dut.run_until_done();
  }
  void expect_engine(const engine::Options& options) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + text(options) + ": " + describe(job));
    engine::Engine e(job.array, job.topology, options);
    load(e, job);
    e.run(job.threshold, job.max_sweeps, job.rule);
    const spec::Extremes& x = dut.device.cells.extremes;
    EXPECT_EQ(e.extremes().least_sum, x.least_sum);
    EXPECT_EQ(e.extremes().largest_sum, x.largest_sum);
    EXPECT_EQ(e.extremes().least_drive, x.least_drive);
    EXPECT_EQ(e.extremes().largest_drive, x.largest_drive);
  }
  const std::uint64_t seed;
  const ArrayJob job;
  Dut dut;
};

ArrayJob fast_job(std::uint64_t seed) {
  Dice dice(seed);
  const spec::Topology topology = random_topology(dice, 40);
  return random_codes(dice, random_fast_array(dice, topology, static_cast<spec::Normaliser>(seed % 3)),
                      topology);
}

TEST(EngineSwings, OfAnyArrayEqualThoseOfSystemC) {
  std::vector<std::unique_ptr<Bench>> benches;
  for (std::uint64_t seed = 1200000; seed < 1200250; ++seed)
    benches.push_back(std::make_unique<Bench>(seed, random_job(seed, 40)));
  for (auto& bench : benches) bench->run_systemc();
  for (auto& bench : benches)
    for (const engine::Options& options :
         {engine::Options{1, "auto", 2}, {1, "generic", 1}, {2, "generic", 1}})
      bench->expect_engine(options);
}

TEST(EngineSwings, OfEveryKernelEqualThoseOfSystemC) {
  std::vector<std::unique_ptr<Bench>> benches;
  for (std::uint64_t seed = 1300000; seed < 1300250; ++seed)
    benches.push_back(std::make_unique<Bench>(seed, fast_job(seed)));
  for (auto& bench : benches) bench->run_systemc();
  for (auto& bench : benches)
    for (const std::string& kernel : kernels_here()) bench->expect_engine({1 + bench->seed % 2, kernel, 1});
}

} // namespace
} // namespace hopmesh::tests
