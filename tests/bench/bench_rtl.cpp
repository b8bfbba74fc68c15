// How fast the array is at register-transfer level: the RTL of rtl_model/verilog as the level `rtl` simulates
// it, beside the levels that do the same work to the bit and to the cycle. A single process, turns at random,
// like bench_array.
#include "sim/engine/engine.h"
#include "sim/levels/bus_array.h"
#include "sim/levels/level.h"
#include "tests/bench/flag_network.h"

#include "place.h"

#include <cstdlib>

namespace hopmesh::bench {
namespace {

/// The flag on sixteen elements and one stage. Everything SystemC, made before simulation begins.
struct Arrays {
  Arrays()
      : inputs(scene::read_inputs(HOPMESH_SOURCE_DIR "/sim/scenes/flag-400.toml", "folded", {})),
        mesh(inputs.scene), production("production", inputs.array, mesh.topology()),
        steps(inputs.scene, mesh, production) {}

  void find_network() {
    network.find(production, mesh.topology(), steps);
    rtl = levels::level_named("rtl", "").make_port(inputs.array, mesh.topology(), {});
  }

  scene::Inputs inputs;
  levels::BuiltMesh mesh;
  tests::Dut production;
  FlagSteps steps;
  FlagNetwork network;
  std::unique_ptr<levels::ArrayPort> rtl;
};

/// Loading is not counted, preparing is: it is part of a run.
void run_rtl(benchmark::State& state, Arrays& a) {
  const spec::Topology topology = a.mesh.topology();
  const levels::BusArray array(a.rtl->bus(), topology);
  const FlagNetwork& n = a.network;
  array.load(n.weights, n.biases, n.start);
  spec::Relaxation r;
  for (auto _ : state) {
    state.PauseTiming();
    array.put_outputs(n.start);
    state.ResumeTiming();
    r = array.run(0, sweeps_a_run);
  }
  report(state, n, {array.outputs(), r.sweeps, r.cycles, r.largest_change});
}

/// The yardstick that bench_array has as well, so that its file and this one's can be put side by side.
void run_production(benchmark::State& state, Arrays& a) {
  a.network.load(a.production);
  for (auto _ : state) {
    state.PauseTiming();
    a.production.put_codes(tests::Window::OUTPUT, a.network.start);
    state.ResumeTiming();
    FlagNetwork::run(a.production);
  }
  report(state, a.network, a.network.outcome_of_production(a.production));
}

/// The engine's runs are as long as the flag's: the others' would be over before a clock can tell. What it is
/// held to first is the run that all share.
void run_engine(benchmark::State& state, Arrays& a) {
  constexpr std::uint32_t sweeps_of_a_step = 280;
  engine::Engine e(a.inputs.array, a.mesh.topology(), {1});
  const auto words = [](const std::vector<std::int32_t>& codes) {
    return reinterpret_cast<const std::uint32_t*>(codes.data());
  };
  const FlagNetwork& n = a.network;
  e.write_weights(0, words(n.weights), n.weights.size());
  e.write_biases(0, words(n.biases), n.biases.size());
  e.write_outputs(0, words(n.start), n.start.size());
  const spec::Relaxation first = e.run(0, sweeps_a_run);
  Outcome outcome{std::vector<std::int32_t>(n.start.size()), first.sweeps, first.cycles,
                  first.largest_change};
  e.read_outputs(0, reinterpret_cast<std::uint32_t*>(outcome.outputs.data()), outcome.outputs.size());
  if (!(outcome == n.expected)) state.SkipWithError("other codes, sweeps or cycles than woken by phase");
  std::uint64_t sweeps = 0, cycles = 0;
  for (auto _ : state) {
    const spec::Relaxation r = e.run(0, sweeps_of_a_step);
    sweeps += r.sweeps;
    cycles += r.cycles;
  }
  using benchmark::Counter;
  state.counters["updates/s"] =
      Counter(static_cast<double>(sweeps) * static_cast<double>(n.biases.size()), Counter::kIsRate);
  state.counters["cycles/s"] = Counter(static_cast<double>(cycles), Counter::kIsRate);
}

/// A fixed number of runs a turn: long enough to time, short enough that the turns alternate often. A further
/// level that does the same work is one more line here, with its own body above.
void register_all(Arrays& a) {
  const auto add = [](const char* name, int runs, auto body) {
    benchmark::RegisterBenchmark(name, body)->Iterations(runs)->Repetitions(9)->Unit(benchmark::kMillisecond);
  };
  add("flag-400 rtl/SystemC, by phase", 60, [&a](benchmark::State& s) { run_production(s, a); });
  add("flag-400 rtl/RTL, Verilator", 10, [&a](benchmark::State& s) { run_rtl(s, a); });
  add("flag-400 rtl/engine", 2000, [&a](benchmark::State& s) { run_engine(s, a); });
}

} // namespace
} // namespace hopmesh::bench

int sc_main(int argc, char** argv) {
  hopmesh::bench::Arrays arrays;
  hopmesh::tests::Dut::elaborate();
  arrays.find_network();
  hopmesh::bench::register_all(arrays);
  return hopmesh::bench::run_benchmarks(argc, argv);
}

int main(int argc, char** argv) {
  setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
  return sc_core::sc_elab_and_sim(argc, argv);
}
