// How fast the array runs on the 400-node flag: woken by phase, by clock, by clock with a wave, folded, and
// written with sc_fixed. All in one process and in random turns, so that ratios are fair on a noisy machine;
// all must give the same codes, and all but the folded one in the same cycles.
#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "tests/bench/flag_network.h"
#include "tests/bench/sc_fixed_array.h"

#include "place.h"

#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <sysc/tracing/sc_tracing_ids.h>
#include <unistd.h>

namespace hopmesh::bench {
namespace {

/// Everything SystemC, made before simulation begins.
struct Arrays {
  Arrays()
      : inputs(scene::read_inputs(HOPMESH_SOURCE_DIR "/sim/scenes/flag-400.toml", "", {})),
        mesh(inputs.scene), production("production", inputs.array, mesh.topology()),
        folded("folded", spec::folded_array(), mesh.topology()),
        sc_fixed("sc_fixed", inputs.array, mesh.topology()), steps(inputs.scene, mesh, production) {}

  scene::Inputs inputs;
  levels::BuiltMesh mesh;
  tests::Dut production, folded;
  ScFixedArray sc_fixed;
  FlagSteps steps;
  FlagNetwork network;

  void find_network() {
    network.find(production, mesh.topology(), steps);
    load_sc_fixed();
  }
  void load_sc_fixed() { sc_fixed.load(network.weights, network.biases, network.start); }
};

Outcome outcome_after_runs(benchmark::State& state, Arrays& a, tests::Dut& dut, systemc::Waking waking) {
  a.network.load(dut);
  dut.device.wake(waking);
  for (auto _ : state) {
    state.PauseTiming();
    dut.put_codes(tests::Window::OUTPUT, a.network.start);
    state.ResumeTiming();
    FlagNetwork::run(dut);
  }
  return a.network.outcome_of_production(dut);
}

void run_production(benchmark::State& state, Arrays& a, systemc::Waking waking) {
  report(state, a.network, outcome_after_runs(state, a, a.production, waking));
}

/// Sixteen elements and a single stage: the same codes, and the cycles of the fold.
void run_folded(benchmark::State& state, Arrays& a, systemc::Waking waking) {
  FlagNetwork network = a.network;
  network.expected.cycles = a.folded.device.cells.cycles().run(sweeps_a_run);
  report(state, network, outcome_after_runs(state, a, a.folded, waking));
}

void by_phase(benchmark::State& state, Arrays& a) {
  run_production(state, a, systemc::Waking::by_phase);
}

void by_clock(benchmark::State& state, Arrays& a) {
  run_production(state, a, systemc::Waking::by_clock);
}

void by_phase_folded(benchmark::State& state, Arrays& a) {
  run_folded(state, a, systemc::Waking::by_phase);
}

void by_clock_folded(benchmark::State& state, Arrays& a) {
  run_folded(state, a, systemc::Waking::by_clock);
}

/// The wave holds every register of every neuron, as `hopmesh run --wave` writes it.
void by_clock_with_wave(benchmark::State& state, Arrays& a) {
  const auto name = std::filesystem::temp_directory_path() / ("hopmesh-bench-" + std::to_string(getpid()));
  auto* file = sc_core::sc_create_vcd_trace_file(name.c_str());
  file->set_time_unit(1, sc_core::SC_NS);
  const auto& cells = a.production.device.cells;
  cells.sequencer.trace(file);
  std::vector<std::size_t> all(a.mesh.cells());
  std::iota(all.begin(), all.end(), std::size_t{0});
  cells.trace_cells(file, all);
  run_production(state, a, systemc::Waking::by_clock);
  sc_core::sc_close_vcd_trace_file(file);
  std::filesystem::remove(name.string() + ".vcd");
}

void sc_fixed(benchmark::State& state, Arrays& a) {
  for (auto _ : state) {
    state.PauseTiming();
    a.load_sc_fixed();
    state.ResumeTiming();
    a.sc_fixed.run(0, sweeps_a_run);
  }
  report(state, a.network, outcome_of(a.sc_fixed));
}

/// All steps of the scene: who takes how much of the processor.
void parts_of_steps(benchmark::State& state, Arrays& a) {
  a.production.device.wake(systemc::Waking::by_phase);
  for (auto _ : state) {
    a.steps.begin();
    for (std::int64_t k = 0; k < a.inputs.scene.motion.steps; ++k) a.steps.advance();
  }
  const PartSeconds& s = a.steps.seconds();
  state.counters["array_s"] = s.array;
  state.counters["bus_s"] = s.bus;
  state.counters["driver_s"] = s.driver;
  state.counters["network_and_motion_s"] = s.network_and_motion;
  state.counters["cycles"] = static_cast<double>(a.steps.cycles());
}

/// A fixed number of runs a turn: long enough to time, short enough that the turns alternate often.
void register_all(Arrays& a) {
  const auto add = [&a](const char* name, void (*body)(benchmark::State&, Arrays&), int runs, int turns) {
    benchmark::RegisterBenchmark(name, [&a, body](benchmark::State& state) { body(state, a); })
        ->Iterations(runs)
        ->Repetitions(turns)
        ->Unit(benchmark::kMillisecond);
  };
  add("flag-400/by phase", by_phase, 60, 9);
  add("flag-400/by clock", by_clock, 2, 9);
  add("flag-400/by phase, folded", by_phase_folded, 60, 9);
  add("flag-400/by clock, folded", by_clock_folded, 1, 9);
  add("flag-400/by clock, wave on", by_clock_with_wave, 1, 9);
  add("flag-400/sc_fixed, a signal per value", sc_fixed, 1, 9);
  add("flag-400 steps/parts", parts_of_steps, 1, 1);
}

} // namespace
} // namespace hopmesh::bench

int sc_main(int argc, char** argv) {
  sc_core::sc_report_handler::set_actions(sc_core::SC_ID_TRACING_TIMESCALE_UNIT_, sc_core::SC_DO_NOTHING);
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
