#include "tests/bench/flag_network.h"

#include "firmware/registers.h"

namespace hopmesh::bench {
namespace {

constexpr int warm_up_steps = 20; ///< after these the flag moves and its networks are no longer special

} // namespace

// The network of the last warm-up step, read back from the array that the firmware loaded.
void FlagNetwork::find(tests::Dut& production, const spec::Topology& topology, FlagSteps& steps) {
  steps.begin();
  for (int k = 0; k < warm_up_steps; ++k) steps.advance();
  weights = production.codes(tests::Window::WEIGHT, topology.weight_words());
  biases = production.codes(tests::Window::BIAS, topology.neurons());
  start = steps.start_raw();
  load(production);
  run(production);
  expected = outcome_of_production(production);
}

void FlagNetwork::load(tests::Dut& production) const {
  production.put_codes(tests::Window::WEIGHT, weights);
  production.put_codes(tests::Window::BIAS, biases);
  production.put_codes(tests::Window::OUTPUT, start);
}

void FlagNetwork::run(tests::Dut& production) {
  production.start(0, sweeps_a_run);
  production.run_until_done();
}

Outcome FlagNetwork::outcome_of_production(tests::Dut& production) const {
  return {production.codes(tests::Window::OUTPUT, biases.size()), production.read(HM_REG_SWEEPS),
          production.read(HM_REG_CYCLES_LO), production.read(HM_REG_LARGEST_CHANGE)};
}

void report(benchmark::State& state, const FlagNetwork& network, const Outcome& outcome) {
  if (!(outcome == network.expected))
    state.SkipWithError("other codes, sweeps or cycles than woken by phase");
  using benchmark::Counter;
  const auto runs = static_cast<double>(state.iterations());
  const auto updates = static_cast<double>(outcome.sweeps * network.biases.size());
  state.counters["updates/s"] = Counter(runs * updates, Counter::kIsRate);
  state.counters["cycles/s"] = Counter(runs * static_cast<double>(outcome.cycles), Counter::kIsRate);
}

int run_benchmarks(int argc, char** argv) {
  std::vector<char*> words(argv, argv + argc);
  std::string turns = "--benchmark_enable_random_interleaving=true";
  words.insert(words.begin() + 1, turns.data());
  int count = static_cast<int>(words.size());
  benchmark::Initialize(&count, words.data());
  if (benchmark::ReportUnrecognizedArguments(count, words.data())) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

} // namespace hopmesh::bench
