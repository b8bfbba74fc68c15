// A point of a study beside its bare run: what judging and measuring cost, in runs of the engine. Turns of
// the two alternate in one process, so that what else the machine does meets both. Processor time.
#include "sim/levels/level.h"
#include "sim/study/point_runner.h"
#include "sim/study/reference_store.h"
#include "sim/study/sensitivity_store.h"
#include "sim/study/truth_store.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <unistd.h>

namespace hopmesh::bench {
namespace {

constexpr std::int64_t steps = 100;
constexpr int turns = 15;
const std::atomic<bool> never{false};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work> double seconds_of(Work work) {
  const double began = processor_seconds();
  work();
  return processor_seconds() - began;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::filesystem::path shared_folder() {
  return std::filesystem::temp_directory_path() / ("hopmesh-bench-point-" + std::to_string(getpid()));
}

/// A level, and what it is made from.
struct Kept {
  levels::Prepared prepared;
  levels::ReadyLevel level;
};

std::shared_ptr<Kept> engine_of(const scene::Inputs& inputs, bool check) {
  auto kept = std::make_shared<Kept>();
  kept->prepared = {inputs, std::make_unique<levels::BuiltMesh>(inputs.scene)};
  kept->level = levels::make_ready(levels::default_level(), kept->prepared, check);
  return kept;
}

void fly_bare(const scene::Inputs& inputs) {
  const auto kept = engine_of(inputs, false);
  benchmark::DoNotOptimize(run::simulate(*kept->level.mover, steps, {}, never));
}

/// As `sweep` makes a point: the motions that all points share lie in the folder.
study::Methods methods_in(const std::filesystem::path& folder) {
  study::Methods methods;
  methods.make = [](const std::string&, const scene::Inputs& inputs) {
    auto kept = engine_of(inputs, true);
    levels::Mover* mover = kept->level.mover.get();
    return std::shared_ptr<levels::Mover>(kept, mover);
  };
  methods.truth = [folder](auto& inputs, auto& mesh, auto& times) {
    return study::TruthStore(folder).at(inputs, mesh, times);
  };
  methods.reference = [folder](auto& inputs, auto& mesh, auto& times, std::uint64_t count, auto& stop) {
    return study::ReferenceStore(folder).at(inputs, mesh, times, count, stop);
  };
  methods.sensitivity = [folder](auto& inputs, auto& mesh, auto& times) {
    return study::SensitivityStore(folder).at(inputs, mesh, times);
  };
  return methods;
}

void point(benchmark::State& state, const std::string& scene) {
  const scene::Inputs inputs = scene::read_inputs(scene, "", {"motion.steps=" + std::to_string(steps)});
  const std::filesystem::path folder = shared_folder();
  std::filesystem::create_directories(folder);
  const study::Methods methods = methods_in(folder);
  const std::vector<double> times{inputs.scene.motion.time_step * static_cast<double>(steps)};
  const auto run = [&] {
    study::Point asked;
    asked.method = levels::default_level().name;
    benchmark::DoNotOptimize(study::run_point(asked, inputs, times, methods, never));
  };
  const double first = seconds_of(run);
  std::vector<double> bare, judged;
  for (auto _ : state) {
    bare.push_back(seconds_of([&] { fly_bare(inputs); }));
    judged.push_back(seconds_of(run));
    state.SetIterationTime(judged.back());
  }
  state.counters["bare_ms"] = 1e3 * median(bare);
  state.counters["point_ms"] = 1e3 * median(judged);
  state.counters["bare_runs"] = median(judged) / median(bare);
  state.counters["shared_ms"] = 1e3 * (first - median(judged));
  std::filesystem::remove_all(folder);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  for (const char* scene : {"flag-225", "flag-400", "banner", "stiff"})
    benchmark::RegisterBenchmark((std::string("point/") + scene).c_str(),
                                 [scene](benchmark::State& state) { hopmesh::bench::point(state, scene); })
        ->Iterations(hopmesh::bench::turns)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
