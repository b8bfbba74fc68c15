// Whole files of firings: of a scene's step or made at random, edges first.
#pragma once

#include "sim/cosim/firings/firing_files.h"
#include "sim/cosim/vectors.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

/// Levels that can lay a neuron open.
std::vector<std::string> open_levels();

struct FiringsWanted {
  std::filesystem::path path;
  FiringFormat format = FiringFormat::text;
  bool blank = false;
};

struct FiringsWritten {
  std::uint64_t edges = 0, others = 0;
  std::uint32_t shown = 0; ///< edges that a line shows
  bool interrupted = false;
};

/// Every firing of the run of a case, behind the array's edges.
FiringsWritten write_firings(const FiringsWanted& wanted, const VectorCase& a_case,
                             const levels::Level& level);
/// `count` firings at random of rows of up to `taps` inputs, behind the edges. Throws input::InputError for
/// an array that cannot have such rows; `file` it came from.
FiringsWritten write_random_firings(const FiringsWanted& wanted, const spec::ArraySpec& array,
                                    const std::string& file, std::size_t taps, std::uint64_t seed,
                                    std::uint64_t count, const levels::Level& level);

/// Edges that no line shows, for people; "" where all are there.
std::string missing_edges(std::uint32_t shown);

} // namespace hopmesh::cosim
