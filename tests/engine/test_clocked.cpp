// The clock-stepped engine beside the SystemC array woken by clock: every register of every neuron after
// every clock; and at the end of a run the engine's.
#include "rtl_model/spec/presets.h"
#include "tests/engine/clocked_pair.h"
#include "tests/engine/engine_bench.h"

namespace hopmesh::tests {
namespace {

using engine::ClockedEngine;

class Clocked : public testing::TestWithParam<int> {};

/// Arrays of any kind.
TEST_P(Clocked, EqualsTheSystemcArrayAfterEveryClock) {
  const std::uint64_t first = 20000 + 12 * static_cast<std::uint64_t>(GetParam());
  std::vector<ArrayJob> jobs;
  std::vector<std::unique_ptr<Dut>> duts; // SystemC wants all of them before the first moves
  for (std::uint64_t seed = first; seed < first + 12; ++seed) {
    jobs.push_back(random_job(seed, 24));
    jobs.back().max_sweeps = 1 + static_cast<std::uint32_t>(seed % 3);
    const std::string name = "seed_" + std::to_string(seed);
    duts.push_back(std::make_unique<Dut>(name.c_str(), jobs.back().array, jobs.back().topology));
  }
  for (std::size_t k = 0; k < jobs.size() && !HasFailure(); ++k) {
    SCOPED_TRACE(duts[k]->name());
    Dice dice(first + k);
    expect_alike(*duts[k], jobs[k], dice, 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Random, Clocked, testing::Range(0, 10));

struct Kind {
  spec::Schedule schedule;
  spec::Normaliser normaliser;
  int lanes;
  bool exact;
  spec::Output output = spec::Output::modified;
  int per_cell = 3;
  int elements = 0;
  spec::Stages stages = spec::Stages::each;
  int pipeline = 0;
};

class ClockedKinds : public testing::TestWithParam<Kind> {};

std::string name_of_kind(const testing::TestParamInfo<Kind>& kind) {
  return std::string(spec::name_of(kind.param.schedule)) + "_" +
         std::string(spec::name_of(kind.param.normaliser)) + "_" + std::to_string(kind.param.lanes) +
         (kind.param.exact ? "_exact_" : "_rounding_") + std::string(spec::name_of(kind.param.output)) + "_" +
         std::to_string(kind.param.per_cell) + "_on_" + std::to_string(kind.param.elements) + "_" +
         std::string(spec::name_of(kind.param.stages)) + "_" + std::to_string(kind.param.pipeline);
}

/// A grid so large that banks have several blocks of lanes and rows of three lengths.
TEST_P(ClockedKinds, EqualTheSystemcArrayOnAGrid) {
  Dice dice(30000);
  spec::ArraySpec array = spec::default_array();
  array.schedule = GetParam().schedule;
  array.normaliser = GetParam().normaliser;
  array.output = GetParam().output;
  array.lanes = GetParam().lanes;
  array.elements = GetParam().elements;
  array.stages = GetParam().stages;
  array.pipeline = GetParam().pipeline;
  array.exact_accumulator = GetParam().exact;
  array.formats.accumulator = {24, 9, spec::Rounding::rnd_conv, spec::Overflow::sat};
  const bool one_by_one = array.schedule == spec::Schedule::sequential;
  const int n = GetParam().per_cell;
  ArrayJob job =
      lively_job(30001, array, one_by_one ? grid_topology(3, 4, true, n) : grid_topology(9, 11, true, n));
  job.max_sweeps = 2;
  give_rule(dice, job);
  Dut dut("grid", job.array, job.topology);
  expect_alike(dut, job, dice, 1);
}

spec::Schedule schedule_for(spec::Output output) {
  return output == spec::Output::momentum ? spec::Schedule::synchronous : spec::Schedule::coloured;
}

std::vector<Kind> kinds() {
  std::vector<Kind> all;
  for (int schedule = 0; schedule < 3; ++schedule)
    for (int normaliser = 0; normaliser < 3; ++normaliser)
      for (int lanes : {1, 2, 4, 5, 64})
        for (bool exact : {true, false})
          all.push_back({static_cast<spec::Schedule>(schedule), static_cast<spec::Normaliser>(normaliser),
                         lanes, exact});
  for (int schedule = 0; schedule < 3; ++schedule)
    for (int lanes : {1, 4})
      for (int per_cell : {1, 2})
        for (auto output : {spec::Output::modified, spec::Output::binary})
          all.push_back({static_cast<spec::Schedule>(schedule), spec::Normaliser::reciprocal, lanes, true,
                         output, per_cell});
  for (auto output : {spec::Output::projected, spec::Output::momentum})
    for (auto normaliser : {spec::Normaliser::reciprocal, spec::Normaliser::divider})
      for (int lanes : {1, 4})
        for (bool exact : {true, false})
          all.push_back({schedule_for(output), normaliser, lanes, exact, output, 1 + lanes / 2});
  return all;
}

/// Folded, and with as many registers as a normaliser can have.
std::vector<Kind> folded_kinds() {
  std::vector<Kind> all;
  for (int schedule = 0; schedule < 3; ++schedule)
    for (int normaliser = 0; normaliser < 3; ++normaliser)
      for (int elements : {0, 1, 3, 16, 300})
        for (int registers = normaliser == 0 ? 3 : 4; registers >= 0; registers -= elements ? 2 : 1)
          for (auto stages : {spec::Stages::each, spec::Stages::one})
            if (elements > 0 || stages == spec::Stages::each)
              all.push_back({static_cast<spec::Schedule>(schedule), static_cast<spec::Normaliser>(normaliser),
                             registers == 2 ? 4 : 1, registers != 0, spec::Output::modified, 3, elements,
                             stages, registers});
  for (int elements : {1, 5, 300})
    for (auto stages : {spec::Stages::each, spec::Stages::one})
      all.push_back({spec::Schedule::coloured, spec::Normaliser::divider, 2, true, spec::Output::binary, 2,
                     elements, stages});
  for (auto output : {spec::Output::projected, spec::Output::momentum})
    for (auto normaliser : {spec::Normaliser::reciprocal, spec::Normaliser::divider})
      for (int elements : {0, 1, 5, 300})
        for (int registers = output == spec::Output::momentum ? 3 : 2; registers > 0; --registers)
          for (auto stages : {spec::Stages::each, spec::Stages::one})
            if (elements > 0 || stages == spec::Stages::each)
              all.push_back({schedule_for(output), normaliser, registers, true, output, 3, elements, stages,
                             registers});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Folded, ClockedKinds, testing::ValuesIn(folded_kinds()), name_of_kind);
INSTANTIATE_TEST_SUITE_P(All, ClockedKinds, testing::ValuesIn(kinds()), name_of_kind);

TEST(ClockedEngine, StaysIdleWithoutStartAndAfterTheEnd) {
  ClockedEngine e(spec::default_array(), grid_topology(2, 2, true));
  e.step(10);
  EXPECT_EQ(e.segment(), spec::Segment::idle);
  EXPECT_FALSE(e.done());
  EXPECT_EQ(e.result().cycles, 0u);
  e.start(0, 0); // 0 sweeps are taken as 1
  e.step(UINT64_MAX);
  EXPECT_TRUE(e.done() && !e.busy());
  EXPECT_EQ(e.result().cycles, e.cycles().run(1));
  e.step();
  EXPECT_EQ(e.result().cycles, e.cycles().run(1));
}

} // namespace
} // namespace hopmesh::tests
