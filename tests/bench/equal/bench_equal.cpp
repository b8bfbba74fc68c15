// The time of a step of the array and of its implicit rivals at equal answers: each rival is stopped where it
// is as far from the step solved exactly as the array is, in the mean (rms) over the steps that the array
// flies. Processor time of one thread; of the array, the hardware's time at its clock, and that of its
// emulation.
#include "sim/levels/processor_time.h"
#include "tests/bench/equal/equal_steps.h"

#include <benchmark/benchmark.h>
#include <list>
#include <map>
#include <memory>

namespace hopmesh::bench {
namespace {

constexpr int turns = 5;
constexpr std::size_t most_steps = 50;

struct Flight {
  std::string name, scene;
  std::vector<std::string> overrides;
  std::vector<std::string> rivals;
};

/// Of each scene the implicit step of first order, and that of BDF2, which is another one.
std::vector<Flight> flights() {
  const std::vector<std::string> euler = {"linearly_implicit", "projective_dynamics", "backward_euler"};
  std::vector<Flight> all;
  for (const std::string scene : {"banner", "stiff", "tablecloth", "soft-block", "free-net"}) {
    all.push_back({scene, scene, {}, euler});
    all.push_back({scene + "-bdf2", scene, {"incremental.rule=bdf2"}, {"bdf2"}});
  }
  return all;
}

/// The steps of a flight, flown when a benchmark first asks for them.
class Lazy {
 public:
  explicit Lazy(Flight flight) : flight_(std::move(flight)) {}
  const Flight& flight() const { return flight_; }
  const EqualSteps& steps() {
    if (!steps_) steps_ = std::make_unique<EqualSteps>(flight_.scene, flight_.overrides, most_steps);
    return *steps_;
  }
  double tolerance(const std::string& method) {
    const auto [place, fresh] = tolerance_.try_emplace(method, 0);
    if (fresh) place->second = steps().equal_tolerance(method);
    return place->second;
  }

 private:
  const Flight flight_;
  std::unique_ptr<EqualSteps> steps_;
  std::map<std::string, double> tolerance_;
};

/// Steps in turn, each from the array's start of it; what puts a rival there is not timed.
void rival(benchmark::State& state, Lazy& lazy, const std::string& method) {
  const EqualSteps& steps = lazy.steps();
  const double tolerance = lazy.tolerance(method);
  if (tolerance == 0) return state.SkipWithError("no tolerance brings it as near as the array");
  const auto count = static_cast<double>(steps.count());
  double all_seconds = 0, iterations = 0;
  for (auto _ : state) {
    const auto rival = steps.make(method, tolerance);
    double seconds = 0;
    for (std::size_t k = 0; k < steps.count(); ++k) {
      steps.place(*rival, k);
      const double began = levels::processor_seconds();
      rival->advance();
      seconds += levels::processor_seconds() - began;
    }
    state.SetIterationTime(seconds);
    all_seconds += seconds;
    iterations = static_cast<double>(rival->counters().iterations);
  }
  state.counters["s/step"] = all_seconds / count / static_cast<double>(state.iterations());
  state.counters["tolerance"] = tolerance;
  state.counters["error"] = steps.error(method, tolerance);
  state.counters["iterations/step"] = iterations / count;
}

/// Cycles are the same each time; what is timed is the emulation. `wide`: a multiplier an input, and four
/// words a beat of the bus.
void array(benchmark::State& state, Lazy& lazy) {
  const EqualSteps& steps = lazy.steps();
  std::vector<std::string> wide = lazy.flight().overrides;
  wide.insert(wide.end(), {"array.lanes=27", "array.bus_bits=128"});
  const ArrayTime broad = array_time(lazy.flight().scene, wide, most_steps);
  const ArrayTime& time = steps.array();
  for (auto _ : state) state.SetIterationTime(time.emulation * static_cast<double>(steps.count()));
  state.counters["hardware s/step"] = time.hardware();
  state.counters["bus s/step"] = time.bus;
  state.counters["wide s/step"] = broad.hardware();
  state.counters["s/step"] = time.emulation;
  state.counters["error"] = steps.array_error();
  state.counters["iterations/step"] = time.sweeps;
}

void add_all(std::list<Lazy>& all) {
  for (const Flight& flight : flights()) {
    Lazy& lazy = all.emplace_back(flight);
    const auto add = [&](const std::string& name, auto body) {
      return benchmark::RegisterBenchmark(("equal/" + flight.name + '/' + name).c_str(), body)
          ->Unit(benchmark::kMillisecond)
          ->UseManualTime();
    };
    add("array", [&lazy](benchmark::State& s) { array(s, lazy); })->Iterations(1);
    for (const std::string& method : flight.rivals)
      add(method, [&lazy, method](benchmark::State& s) { rival(s, lazy, method); })->Repetitions(turns);
  }
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  std::list<hopmesh::bench::Lazy> flights;
  hopmesh::bench::add_all(flights);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
