// The program at work on the problem set: what its files say, level by level.
#pragma once

#include "sim/networks/problems/problem.h"

#include <filesystem>
#include <optional>

namespace hopmesh::bench {

struct Solved {
  std::uint64_t sweeps = 0, cycles = 0;
  bool converged = false;
  double energy = 0;
  std::string verdict, V; ///< V.mtx as it is
};

class ProblemRuns {
 public:
  ProblemRuns(std::string program, std::filesystem::path folder)
      : program_(std::move(program)), folder_(std::move(folder)) {}

  /// `hopmesh solve WHAT --level LEVEL MORE`. Throws std::runtime_error where it ends with neither 0 nor 1.
  Solved solve(const std::string& what, const std::string& level, const std::string& more = "") const;
  /// `hopmesh network SCENE --step STEP`, as a problem called like scene and step, and the words for solve().
  problems::Problem network(const std::string& scene, int step, std::string& what) const;
  /// Writes a problem's files; the words for solve().
  std::string written(const problems::Problem& problem) const;

 private:
  int run(const std::string& words) const;

  const std::string program_;
  const std::filesystem::path folder_;
};

} // namespace hopmesh::bench
