// The network that every benchmark of the array relaxes: that of a step of the moving flag; and what must
// come out.
#pragma once

#include "tests/bench/flag_steps.h"

#include <benchmark/benchmark.h>

namespace hopmesh::bench {

constexpr std::uint32_t sweeps_a_run = 20;

struct Outcome {
  std::vector<std::int32_t> outputs;
  std::uint64_t sweeps = 0, cycles = 0, largest_change = 0;
  bool operator==(const Outcome& o) const {
    return outputs == o.outputs && sweeps == o.sweeps && cycles == o.cycles &&
           largest_change == o.largest_change;
  }
};

/// Of any model with these four names.
template <class Array> Outcome outcome_of(const Array& array) {
  return {array.outputs_raw(), array.sweeps(), array.cycles(), array.largest_change_raw()};
}

/// Found by flying the flag on the production array, woken by phase, which says what is expected of others.
struct FlagNetwork {
  std::vector<std::int32_t> weights, biases, start;
  Outcome expected;

  void find(tests::Dut& production, const spec::Topology& topology, FlagSteps& steps);
  void load(tests::Dut& production) const;
  /// A run of sweeps_a_run sweeps, and what it leaves.
  static void run(tests::Dut& production);
  Outcome outcome_of_production(tests::Dut& production) const;
};

/// Rates of a benchmark whose iterations were runs; an error where the last one had another outcome.
void report(benchmark::State& state, const FlagNetwork& network, const Outcome& outcome);

/// Google Benchmark's main, with turns at random. Returns the exit code.
int run_benchmarks(int argc, char** argv);

} // namespace hopmesh::bench
