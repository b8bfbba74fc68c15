// The whole way of one relaxation: doubles, driver, bus, SystemC device, bus, driver, doubles; against the
// slow array fed with the slow oracle's codes. Random meshes, arrays and networks; thirty devices an
// elaboration.
#include "tests/support/driver_case.h"
#include "tests/support/dut_bus.h"

namespace hopmesh::tests {
namespace {

struct Bench {
  explicit Bench(std::uint64_t seed)
      : one(seed), dut(("dut" + std::to_string(seed)).c_str(), one.job.array, one.job.topology), bus(dut) {}
  DriverCase one;
  Dut dut;
  DutBus bus;
};

class CosimDriverBatch : public testing::TestWithParam<int> {};

TEST_P(CosimDriverBatch, FromDoublesToDoubles) {
  std::vector<std::unique_ptr<Bench>> benches;
  for (int k = 0; k < 30; ++k) benches.push_back(std::make_unique<Bench>(9000 + 30 * GetParam() + k));
  for (const auto& bench : benches) bench->one.relax_and_compare(bench->bus.bus());
}

TEST(CosimDriver, ARunThatNobodyWaitedForDoesNotDisturbTheNext) {
  // A platform that stopped waiting leaves the array running; it finishes by itself and its interrupt stays
  // up.
  Bench bench(9500);
  std::uint32_t word;
  hm_driver driver;
  ASSERT_EQ(hm_driver_open(&driver, &bench.bus.bus(), &bench.one.mesh->mesh, &word, 1), HM_OK);
  bench.dut.start(0, 3);
  bench.dut.run_until_done();
  bench.one.relax_and_compare(bench.bus.bus());
}

INSTANTIATE_TEST_SUITE_P(Batch, CosimDriverBatch, testing::Range(0, 10));

} // namespace
} // namespace hopmesh::tests
