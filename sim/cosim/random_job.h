// Arrays, meshes and networks made at random, with corners far more often than chance would: what the levels
// are compared on. A job is a pure function of its seed on every machine.
#pragma once

#include "sim/cosim/array_job.h"

#include <random>
#include <string>
#include <utility>

namespace hopmesh::cosim {

/// Randomness with one meaning everywhere (the standard's distributions differ between libraries).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t bits() { return engine_(); }
  /// 0 ... n - 1
  std::uint64_t below(std::uint64_t n) { return engine_() % n; }
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low) + 1));
  }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  /// In [0, 1)
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Any of the modes that have these names.
  template <typename Mode, std::size_t n> Mode mode(const std::array<std::string_view, n>&) {
    return static_cast<Mode>(below(n));
  }
  /// A code of the format: zero, the ends, one last place, powers of two, or anything.
  std::int64_t code(const spec::NumberFormat& format);

 private:
  std::mt19937_64 engine_;
};

using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Cells 0 ... cells - 1 and the links between them; an edge given twice counts once.
spec::Topology topology_of(std::size_t cells, int neurons_per_cell, const Edges& edges);
/// Structural springs, and shear springs with `diagonals`, between rows * columns free nodes.
spec::Topology grid_topology(std::size_t rows, std::size_t columns, bool diagonals, int neurons_per_cell = 3);
spec::Topology ring_topology(std::size_t cells, int neurons_per_cell = 3);
/// Single cells, grids, rings, trees, stars, sparse and full graphs, isolated cells: 1 to `most_cells` of
/// them, of one to three neurons.
spec::Topology random_topology(Dice& dice, std::size_t most_cells);

/// Any array that spec::validate accepts for rows of `taps` inputs.
spec::ArraySpec random_array(Dice& dice, std::size_t taps);

/// Folds some of all arrays, and gives some a pipeline.
void fold_at_random(Dice& dice, spec::ArraySpec& array);

/// The array with an output stage beyond the paper's, and what that wants: a schedule, a normaliser; or as it
/// was, where no such array can be built for rows of `taps` inputs.
spec::ArraySpec stepping_array(Dice& dice, spec::ArraySpec array, std::size_t taps);
/// Gives some of all jobs such a stage, and its table; and all of them a rule to stop by.
void vary_stage(Dice& dice, ArrayJob& job);
/// Gives a job the table that its array has, and a rule to stop by.
void vary_run(Dice& dice, ArrayJob& job);

/// Everything for one run, on this array and mesh.
ArrayJob random_codes(Dice& dice, const spec::ArraySpec& array, const spec::Topology& topology);
ArrayJob random_job(std::uint64_t seed, std::size_t most_cells = 60);

/// The array in words, for a line about a case that failed.
std::string describe(const ArrayJob& job);

} // namespace hopmesh::cosim
