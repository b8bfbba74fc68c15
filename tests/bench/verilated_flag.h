// The Verilog models of the whole flag, for bench_rtl.
#pragma once

#include "tests/bench/verilated_array.h"

namespace hopmesh::bench {

std::unique_ptr<VerilatedArray> time_multiplexed_flag_array();
std::unique_ptr<VerilatedArray> neuron_modules_flag_array();

} // namespace hopmesh::bench
