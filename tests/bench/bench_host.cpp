// What the host does beside the array, on an array that costs nothing: a step by parts, the files' end, and
// how time and memory grow to a million nodes. A program of its own without SystemC.
#include "rtl_model/spec/schedule.h"
#include "sim/files/output_file.h"
#include "sim/levels/array_mover.h"
#include "sim/run/run_files.h"
#include "tests/bench/null_array.h"

#include "place.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <optional>
#include <sys/resource.h>
#include <unistd.h>

namespace hopmesh::bench {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

std::filesystem::path results_folder() {
  return std::filesystem::temp_directory_path() / ("hopmesh-bench-host-" + std::to_string(getpid()));
}

scene::Inputs inputs_of(int side, std::uint64_t steps) {
  const std::string n = std::to_string(side);
  return scene::read_inputs(
      HOPMESH_SOURCE_DIR "/sim/scenes/flag-400.toml", "",
      {"mesh.grid.rows=" + n, "mesh.grid.columns=" + n, "motion.steps=" + std::to_string(steps)});
}

/// Every stage of a run, in the order of its coming.
struct Stages {
  double read = 0, mesh = 0, colours = 0, first_step = 0, steps = 0, record = 0, finish = 0;
};

/// A whole run: its stages, and the parts of a step.
class HostRun {
 public:
  HostRun(int side, std::uint64_t steps) : steps_(steps) {
    auto began = Clock::now();
    inputs_.emplace(inputs_of(side, steps));
    stages.read = since(began);
    began = Clock::now();
    mesh_.emplace(inputs_->scene);
    stages.mesh = since(began);
    began = Clock::now();
    benchmark::DoNotOptimize(spec::colour_cells(mesh_->topology()));
    stages.colours = since(began);
    array_.emplace(inputs_->array, mesh_->topology());
  }

  void run() {
    levels::ArrayMover motion(inputs_->scene, *mesh_, inputs_->array, *array_, false);
    const run::RunFacts facts{*inputs_, &levels::level_named("systemc", ""), ""};
    run::RunFiles files(results_folder(), facts, *mesh_, motion);
    run::RunResult result;
    for (std::uint64_t k = 0; k < steps_; ++k) {
      auto began = Clock::now();
      result.rows.push_back(motion.advance());
      if (k == 0) stages.first_step = since(began);
      stages.steps += since(began);
      began = Clock::now();
      files.step(result.rows.back(), motion);
      stages.record += since(began);
    }
    const auto began = Clock::now();
    files.finish(result, motion);
    stages.finish = since(began);
    std::filesystem::remove_all(results_folder());
  }

  const HostSeconds& seconds() const { return array_->seconds; }
  Stages stages;

 private:
  const std::uint64_t steps_;
  std::optional<scene::Inputs> inputs_;
  std::optional<levels::BuiltMesh> mesh_;
  std::optional<NullArray> array_;
};

/// Microseconds of a step by part, milliseconds of what comes once a run.
void host(benchmark::State& state, int side, std::uint64_t steps) {
  for (auto _ : state) {
    HostRun run(side, steps);
    run.run();
    const Stages& t = run.stages;
    const HostSeconds& s = run.seconds();
    const double a_step = 1e6 / static_cast<double>(steps);
    const double on_bus = s.network + s.load + s.read_back + s.motion;
    state.SetIterationTime(t.read + t.mesh + t.steps + t.record + t.finish);
    state.counters = {{"network_us", s.network * a_step},
                      {"load_us", s.load * a_step},
                      {"read_back_us", s.read_back * a_step},
                      {"motion_us", s.motion * a_step},
                      {"measures_us", (t.steps - on_bus) * a_step},
                      {"record_us", t.record * a_step},
                      {"read_ms", t.read * 1e3},
                      {"mesh_ms", t.mesh * 1e3},
                      {"colours_ms", t.colours * 1e3},
                      {"first_step_ms", t.first_step * 1e3},
                      {"finish_ms", t.finish * 1e3},
                      {"peak_mb", peak_mb()}};
  }
}

void add(const std::string& name, int side, std::uint64_t steps, int turns) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [side, steps](benchmark::State& state) { host(state, side, steps); })
      ->Iterations(1)
      ->Repetitions(turns)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  hopmesh::bench::add("host/400", 20, 400, 9);
  hopmesh::bench::add("host/10000", 100, 20, 3);
  hopmesh::bench::add("host/1000000", 1000, 2, 1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
