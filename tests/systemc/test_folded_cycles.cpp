// Folded arrays to the cycle: every V absent at n - 1 and present at n, whatever shares the elements.
#include "rtl_model/spec/presets.h"
#include "tests/systemc/cycle_bench.h"
#include "tests/systemc/stage_kinds.h"

namespace hopmesh::tests {
namespace {

using systemc::Waking;

class FoldedToTheCycle : public testing::TestWithParam<std::tuple<std::tuple<int, int>, int>> {};

TEST_P(FoldedToTheCycle, OutputsDoneAndCountersChangeWhenPromised) {
  Benches benches;
  const auto [numbers, stages] = GetParam();
  const auto [schedule, kind] = numbers;
  // Rows of 6 to 15 taps, of 2 to 18 neurons a phase.
  const spec::Topology star = topology_of(6, 3, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}});
  const auto add = [&](int elements, int lanes, int registers) {
    for (Waking waking : {Waking::by_phase, Waking::by_clock}) {
      spec::ArraySpec array = array_with(stage_kinds[kind], static_cast<spec::Schedule>(schedule));
      array.lanes = lanes;
      array.elements = elements;
      array.stages = static_cast<spec::Stages>(stages);
      array.pipeline = std::min(registers, spec::most_pipeline(array));
      ArrayJob job = lively_job(60 + static_cast<std::uint64_t>(elements), array, star);
      job.max_sweeps = 2;
      benches.push_back(std::make_unique<Bench>("dut" + std::to_string(benches.size()), job, waking));
    }
  };
  for (int elements : {1, 2, 3, 5, 18, 40})
    for (int lanes : {1, 27}) add(elements, lanes, 0); // rounds longer than their count, and shorter
  for (int registers : {1, 2, 3, 4}) add(2, 3, registers);
  run_beside_each_other(benches);
}

std::string names(const testing::TestParamInfo<std::tuple<std::tuple<int, int>, int>>& param) {
  const auto [numbers, stages] = param.param;
  const auto [schedule, kind] = numbers;
  return std::string(spec::schedule_names[schedule]) + "_" + stage_kinds[kind].name + "_" +
         std::string(spec::stages_names[stages]);
}
INSTANTIATE_TEST_SUITE_P(All, FoldedToTheCycle,
                         testing::Combine(testing::ValuesIn(schedules_and_stages()), testing::Range(0, 2)),
                         names);

/// Registers of stages that neurons have for themselves.
TEST(Pipelined, OutputsOfCellsChangeWhenPromised) {
  Benches benches;
  for (const StageKind& kind : stage_kinds)
    for (int registers = 1; registers <= 4; ++registers)
      for (Waking waking : {Waking::by_phase, Waking::by_clock}) {
        const bool at_once = kind.output == spec::Output::momentum;
        spec::ArraySpec array =
            array_with(kind, at_once ? spec::Schedule::synchronous : spec::Schedule::coloured);
        if (registers > spec::most_pipeline(array)) continue;
        array.pipeline = registers;
        ArrayJob job = lively_job(90, array, ring_topology(5));
        job.max_sweeps = 2;
        benches.push_back(std::make_unique<Bench>("dut" + std::to_string(benches.size()), job, waking));
      }
  run_beside_each_other(benches);
}

} // namespace
} // namespace hopmesh::tests
