// How fast the engine relaxes flags of any size, and how near that is to what this processor can do at most.
#include "tests/bench/clocked_flag.h"
#include "tests/bench/grid_network.h"

#include <benchmark/benchmark.h>

#include <map>

namespace hopmesh::bench {
namespace {

const GridNetwork& flag(std::size_t rows, const std::string& array) {
  static std::map<std::pair<std::size_t, std::string>, GridNetwork> known;
  auto [at, is_new] = known.try_emplace({rows, array});
  if (is_new) at->second = grid_network(rows, rows, rows <= 100 ? 20 : 2, array, {"relax.max_sweeps=20"});
  return at->second;
}

void sweeps(benchmark::State& state, std::size_t rows, const std::string& array,
            const engine::Options& options) {
  const GridNetwork& network = flag(rows, array);
  engine::Engine e(network.array, network.topology, options);
  network.load(e);
  const auto count =
      static_cast<std::uint32_t>(std::max<std::size_t>(16, 4000000 / network.neurons() / 16 * 16));
  e.run(0, 1);
  std::uint64_t done = 0;
  for (auto _ : state) done += e.run(0, count).sweeps;
  const auto updates = static_cast<double>(done) * static_cast<double>(network.neurons());
  state.counters["updates/s"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
  state.counters["bytes/update"] =
      static_cast<double>(e.bytes_per_sweep()) / static_cast<double>(network.neurons());
  state.SetLabel(e.kernel());
}

/// Clocks of flag-400 on the clock-stepped engine; `how` steps so many.
void clocks(benchmark::State& state, std::int64_t (ClockedFlag::*how)(std::uint64_t)) {
  constexpr std::uint64_t count = 105219; // a run of 282 sweeps, all but one clock
  static ClockedFlag flag;
  (flag.*how)(count);
  for (auto _ : state) benchmark::DoNotOptimize((flag.*how)(count));
  const auto all = static_cast<double>(state.iterations()) * static_cast<double>(count);
  state.counters["cycles/s"] = benchmark::Counter(all, benchmark::Counter::kIsRate);
  state.counters["s/cycle"] =
      benchmark::Counter(all, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  using namespace hopmesh::bench;
  for (std::size_t rows : {15, 20, 40, 100, 316, 1000})
    benchmark::RegisterBenchmark(("engine/" + std::to_string(rows * rows)).c_str(), [=](benchmark::State& s) {
      sweeps(s, rows, "", {1, "auto", 1});
    });
  for (const char* kernel : {"generic", "portable", "avx2"})
    benchmark::RegisterBenchmark((std::string("kernel 400/") + kernel).c_str(), [=](benchmark::State& s) {
      sweeps(s, 20, "", {1, kernel, 1});
    });
  for (const char* array : {"descent", "prescaled", "byte"})
    benchmark::RegisterBenchmark((std::string("array 400/") + array).c_str(), [=](benchmark::State& s) {
      sweeps(s, 20, array, {1, "auto", 1});
    });
  for (int t : {1, 2}) {
    benchmark::RegisterBenchmark(("threads 400/" + std::to_string(t)).c_str(), [=](benchmark::State& s) {
      sweeps(s, 20, "", {std::size_t(t), "auto", 1});
    })->UseRealTime();
    benchmark::RegisterBenchmark(("threads 10000/" + std::to_string(t)).c_str(), [=](benchmark::State& s) {
      sweeps(s, 100, "", {std::size_t(t), "auto", 1});
    })->UseRealTime();
  }
  for (int f : {2, 4, 8, 16})
    benchmark::RegisterBenchmark(("followed 1000000/" + std::to_string(f)).c_str(), [=](benchmark::State& s) {
      sweeps(s, 1000, "", {1, "auto", std::size_t(f)});
    });
  const std::pair<const char*, std::int64_t (ClockedFlag::*)(std::uint64_t)> ways[] = {
      {"clocked/one by one", &ClockedFlag::step},
      {"clocked/all registers copied", &ClockedFlag::step_and_copy},
      {"clocked/in strides", &ClockedFlag::stride}};
  for (const auto& [name, how] : ways)
    benchmark::RegisterBenchmark(name, [how = how](benchmark::State& s) { clocks(s, how); });
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
