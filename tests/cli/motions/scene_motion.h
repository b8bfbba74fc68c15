// A scene run as its users run it, its positions read back: for tests that hold shipped scenes to closed
// forms and solvers.
#pragma once

#include "tests/support/cli_test.h"

#include <cmath>

namespace hopmesh::tests {

/// positions.npy of a run.
struct Positions {
  Array array;

  std::size_t steps() const { return array.shape[0] - 1; }
  std::size_t nodes() const { return array.shape[1]; }
  double at(std::size_t step, std::size_t node, std::size_t p) const {
    return array.values[(step * nodes() + node) * 3 + p];
  }
  /// Mean over the nodes.
  double centre(std::size_t step, std::size_t p) const {
    double sum = 0;
    for (std::size_t i = 0; i < nodes(); ++i) sum += at(step, i, p);
    return sum / static_cast<double>(nodes());
  }
};

/// Root mean square distance of the nodes, each at the end of a step of its own run.
inline double distance(const Positions& a, const Positions& b, std::size_t step, std::size_t step_of_b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.nodes(); ++i)
    for (std::size_t p = 0; p < 3; ++p) squares += std::pow(a.at(step, i, p) - b.at(step_of_b, i, p), 2);
  return std::sqrt(squares / static_cast<double>(a.nodes()));
}
inline double distance(const Positions& a, const Positions& b, std::size_t step) {
  return distance(a, b, step, step);
}

class SceneMotion : public Cli {
 protected:
  /// The words of `hopmesh run`, without --out.
  Positions positions(const std::string& line) {
    return {read_array(results_of(line + " --no-check", "r" + std::to_string(++runs_)) / "positions.npy")};
  }
  /// The reference, relaxed as far as double goes.
  Positions exact(const std::string& line) {
    return positions(line + " --level reference --set relax.threshold=1e-15 --set relax.max_sweeps=100000");
  }
  /// Engine and SystemC, bit for bit.
  void expect_equal_levels(const std::string& line) {
    const std::filesystem::path a = results_of(line + " --no-check --level engine", "engine");
    expect_same_bits(a, results_of(line + " --no-check --level systemc", "systemc"));
  }

 private:
  int runs_ = 0;
};

} // namespace hopmesh::tests
