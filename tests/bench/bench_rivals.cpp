// The rivals' cost for a second of the flag of 400 nodes in table 3 of the measured anchors, beside SUNDIALS
// in the same process: what is compared across machines is the ratio to it, not the time. A single thread,
// processor time.
#include "sim/rivals/integrator.h"
#include "sim/rivals/truth.h"
#include "tests/rivals/rival_meshes.h"

#include <benchmark/benchmark.h>
#include <cmath>

namespace hopmesh::bench {
namespace {

using rivals::Physics;

constexpr double simulated = 2; // s, as in the anchors
constexpr int turns = 5;
/// At which CVODE errs after 0.25 s as it did in the anchors, by 1.6e-8 m: 1e-7 errs by 2.4e-7, 1e-8 by
/// 0.8e-8. (They give a relative tolerance of 1e-6 and do not say which absolute one went with it.)
constexpr double yardstick_tolerance = 1e-8;

/// 1 m x 1 m and 1 kg of cloth, k = 100 N/m, blown across at 15 and 5 m/s and pulled down along its pinned
/// edge.
const Physics& flag() {
  static const Physics physics(tests::sheet(20, 50), {{3, 1, -9.81}, 0.2});
  return physics;
}

/// Seconds a thing, of so many things in all.
benchmark::Counter inverted(double things) {
  return {things, benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

void counted(benchmark::State& state, double steps, double iterations) {
  const auto runs = static_cast<double>(state.iterations());
  state.counters["s/s"] = inverted(runs * simulated);
  state.counters["s/step"] = inverted(runs * steps);
  state.counters["s/iteration"] = inverted(runs * iterations);
}

/// Two seconds from rest.
void walk(benchmark::State& state, const std::string& name, double time_step) {
  const auto steps = static_cast<int>(std::lround(simulated / time_step));
  double iterations = 0;
  for (auto _ : state) {
    const auto method = rivals::make_method(name, flag(), time_step);
    for (int k = 0; k < steps; ++k) method->advance();
    benchmark::DoNotOptimize(method->state());
    iterations = static_cast<double>(method->counters().iterations);
  }
  counted(state, steps, std::max(1.0, iterations));
}

/// The yardstick. Its tolerance is the one whose error after 0.25 s is that of the anchors' run.
void sundials(benchmark::State& state) {
  double steps = 0, passes = 0;
  for (auto _ : state) {
    rivals::Walk adams(flag(), rivals::Multistep::adams, yardstick_tolerance);
    adams.to(simulated);
    steps = static_cast<double>(adams.steps()), passes = static_cast<double>(adams.force_passes());
  }
  counted(state, steps, passes);
}

/// The loops of an instruction set.
void force_pass(benchmark::State& state, const rivals::ForceKernel& kernel) {
  const rivals::Vector position = flag().initial_state().position;
  const rivals::ForcePass pass(static_cast<std::size_t>(flag().nodes()), flag().springs(), kernel);
  rivals::Vector force(position.size());
  for (auto _ : state) {
    pass.forces(position, force);
    benchmark::DoNotOptimize(force.data());
    benchmark::ClobberMemory();
  }
  state.counters["s/pass"] = inverted(static_cast<double>(state.iterations()));
}

/// Steps of the anchors' table, Newton's only once a turn: it takes a second. The last has no anchor.
void add_all() {
  const std::pair<const char*, double> methods[] = {{"symplectic_euler", 0.0033},
                                                    {"velocity_verlet", 0.0033},
                                                    {"rk4", 0.0045},
                                                    {"xpbd", 0.05 / 32},
                                                    {"projective_dynamics", 0.0125},
                                                    {"backward_euler", 0.0125},
                                                    {"bdf2", 0.0125},
                                                    {"linearly_implicit", 0.0125}};
  const auto add = [](const std::string& name, auto body) {
    benchmark::RegisterBenchmark(("rivals/" + name).c_str(), body)
        ->Repetitions(turns)
        ->Unit(benchmark::kMillisecond);
  };
  add("force_pass", [](benchmark::State& s) { force_pass(s, rivals::force_kernels().back()); });
  for (const rivals::ForceKernel& kernel : rivals::force_kernels())
    add(std::string("force_pass/") + kernel.name, [kernel](benchmark::State& s) { force_pass(s, kernel); });
  for (const auto& [name, time_step] : methods)
    add(name, [name = name, time_step = time_step](benchmark::State& s) { walk(s, name, time_step); });
  add("sundials", sundials);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  hopmesh::bench::add_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
