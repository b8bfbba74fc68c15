// Apart from the benchmark, because Verilator's headers change where SystemC's were included before.
#include "tests/bench/verilated_flag.h"

#include <neuron_modules_flag.h>
#include <neuron_modules_flag___024root.h>
#include <neuron_modules_flag_shared_wires.h>
#include <time_multiplexed_flag.h>
#include <time_multiplexed_flag___024root.h>

#include "tests/bench/verilated_model.h"

namespace hopmesh::bench {

std::unique_ptr<VerilatedArray> time_multiplexed_flag_array() {
  return std::make_unique<TimeMultiplexed<time_multiplexed_flag>>(bench_network("flag"));
}

std::unique_ptr<VerilatedArray> neuron_modules_flag_array() {
  return std::make_unique<NeuronModules<neuron_modules_flag>>(bench_network("flag"));
}

} // namespace hopmesh::bench
