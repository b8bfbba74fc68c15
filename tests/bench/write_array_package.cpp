// write_array_package NETWORK FILE [PHASES ELEMENTS TAPS]: the SystemVerilog package of a named network, with
// room for more where a time_multiplexed model is to take other meshes as well.
#include "tests/bench/array_package.h"
#include "tests/bench/bench_networks.h"

#include <cstdio>
#include <exception>
#include <fstream>

int main(int argc, char** argv) {
  using namespace hopmesh::bench;
  if (argc != 3 && argc != 6) {
    std::fprintf(stderr, "usage: write_array_package NETWORK FILE [PHASES ELEMENTS TAPS]\n");
    return 2;
  }
  try {
    Capacity capacity;
    if (argc == 6) capacity = {std::stoul(argv[3]), std::stoul(argv[4]), std::stoul(argv[5])};
    const BenchNetwork network = bench_network(argv[1]);
    std::ofstream file(argv[2]);
    file << array_package(network.array, network.topology, capacity);
    if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "write_array_package: %s\n", e.what());
    return 2;
  }
  return 0;
}
