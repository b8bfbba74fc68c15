// Runs with a wave, and what the wave is held against.
#pragma once

#include "tests/support/cli_test.h"
#include "tests/support/vcd.h"

namespace hopmesh::tests {

/// At the level that the test is for.
class WaveFile : public Cli, public ::testing::WithParamInterface<std::string> {
 protected:
  /// The words of `hopmesh run ...`.
  std::string line(const std::string& arguments, const std::string& level = "") const {
    return "run " + arguments + " --level " + (level.empty() ? GetParam() : level);
  }
  Finished run(const std::string& arguments) const { return hopmesh(line(arguments)); }
  /// A run with a wave, which must end well and say nothing on stderr.
  Vcd wave(const std::string& arguments, const std::string& level = "") const {
    good(line(arguments + " --no-check --out r --wave w.vcd", level));
    return read_vcd(at("w.vcd"));
  }
  std::vector<std::string> column(const std::string& name) const {
    return read_table(at("r/steps.csv")).column.at(name);
  }
  std::vector<std::uint64_t> cycles() const {
    std::vector<std::uint64_t> numbers;
    for (const std::string& text : column("cycles")) numbers.push_back(std::stoull(text));
    return numbers;
  }
};

/// Nine nodes, the first of them pinned: cell c is node c + 1.
inline const std::string nine = "two-nodes --set mesh.grid.rows=3 --set mesh.grid.columns=3 "
                                "--set mesh.springs.shear=1.0 --set relax.max_sweeps=2";

inline std::string neuron(std::size_t cell, std::size_t p) {
  return ".cell_" + std::to_string(cell) + ".neuron_" + std::to_string(p);
}

} // namespace hopmesh::tests
