// What an update of a neuron costs the engine: flag-400 beside networks of the problem set, in one process.
#include "firmware/driver.h"
#include "rtl_model/spec/presets.h"
#include "sim/engine/device.h"
#include "sim/levels/networks/given_network.h"
#include "sim/networks/problems/problem.h"
#include "tests/bench/grid_network.h"

#include <benchmark/benchmark.h>
#include <stdexcept>

namespace hopmesh::bench {
namespace {

using benchmark::Counter;

/// Runs that never come to rest: as a rule a network of this size is still moving.
void sweep(benchmark::State& state, engine::Engine& e, std::size_t weights) {
  const auto neurons = static_cast<double>(e.topology().neurons());
  const auto count = static_cast<std::uint32_t>(std::max(16.0, 4e6 / neurons));
  e.run(0, 16);
  std::uint64_t done = 0;
  for (auto _ : state) done += e.run(0, count).sweeps;
  const double updates = static_cast<double>(done) * neurons;
  state.counters["s/update"] = Counter(updates, Counter::kIsRate | Counter::kInvert);
  state.counters["products/s"] =
      Counter(static_cast<double>(done) * static_cast<double>(weights), Counter::kIsRate);
  state.counters["inputs/update"] = static_cast<double>(weights) / neurons;
  state.SetLabel(e.kernel());
}

void flag(benchmark::State& state) {
  const GridNetwork network = grid_network(20, 20, 20, "", {"relax.max_sweeps=20"});
  engine::Engine e(network.array, network.topology);
  network.load(e);
  sweep(state, e, network.topology.weight_words());
}

void problem(benchmark::State& state, const std::string& name) {
  const problems::Problem p = problems::make(name);
  const levels::GivenNetwork network({p.W, p.bias, p.start}, 0);
  spec::ArraySpec array = spec::default_array();
  if (p.binary) array.output = spec::Output::binary;
  const std::atomic<bool> stop{false};
  engine::Device device(array, network.topology(), {}, stop);
  hm_driver driver;
  std::vector<std::uint32_t> buffer(4096);
  std::vector<double> rows = network.rows(), bias = p.bias, start = p.start;
  hm_network loaded{rows.data(), bias.data(), start.data()};
  hm_relaxation end;
  if (hm_driver_open(&driver, &device.bus(), &network.firmware(), buffer.data(), 4096) != HM_OK ||
      hm_driver_relax(&driver, &network.firmware(), &loaded, 0, 1, &end) != HM_OK)
    throw std::runtime_error("the network was not loaded");
  sweep(state, device.engine(), p.W.entries.size());
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& body) {
  benchmark::RegisterBenchmark(name.c_str(), [body](benchmark::State& state) { body(state); })
      ->Repetitions(5)
      ->Unit(benchmark::kMillisecond)
      ->MinTime(0.1);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  using namespace hopmesh::bench;
  add("flag-400", flag);
  for (const char* name :
       {"box-screened-99856", "box-random-100000", "cut-torus-99856", "box-random-1000", "memory-1000"})
    add(name, [name](benchmark::State& state) { problem(state, name); });
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
