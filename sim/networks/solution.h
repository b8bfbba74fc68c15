// What solving a given network came to, and the files that tell it.
#pragma once

#include "rtl_model/spec/relaxation.h"
#include "sim/levels/networks/network_level.h"

#include <atomic>
#include <filesystem>

namespace hopmesh::networks {

using levels::GivenNetwork, levels::NetworkLevel, levels::array_level, levels::reference_level;

struct Solution {
  spec::Relaxation rest;
  std::uint32_t clipped = 0; ///< weights and biases that did not fit the formats of an array
  std::size_t vanished = 0;  ///< weights and biases that rounding made 0
  Eigen::VectorXd V;
  double energy_at_start = 0, energy = 0;          ///< -1/2 V'WV - I'V of the network as given
  double kkt = 0;                                  ///< how far a step of s_i / N_i can still move an output
  std::optional<levels::Corrected> corrected = {}; ///< where corrections were asked for
  std::uint32_t limit_cycle = 0; ///< sweeps after which the very same outputs come again; 0: none found
};

/// Relaxes; where that does not come to rest, looks whether the outputs go round in a short circle. Not where
/// more than the outputs decides the next sweep, as momentum does.
Solution solve(const GivenNetwork& network, NetworkLevel& level, bool outputs_decide);

/// Corrects it, at most so often; only its sweeps tell where it was before.
void refine(const GivenNetwork& network, NetworkLevel& level, std::uint32_t most, Solution& solution);

/// What was asked, for people and files.
struct SolveLabel {
  std::string network, level, rule, schedule, verdict;
};
/// The summary in a few lines.
std::string text_of(const SolveLabel& label, const GivenNetwork& network, const Solution& solution);
/// V.mtx and summary.json.
void write_solution(const std::filesystem::path& folder, const SolveLabel& label, const GivenNetwork& network,
                    const Solution& solution);

/// Walks the same sweeps again one by one, into solve.csv: sweep, energy, loaded_energy, largest_change.
/// Throws std::logic_error where they do not end at the solution's outputs.
void write_sweeps(const std::filesystem::path& file, const GivenNetwork& network, NetworkLevel& level,
                  const Solution& solution, const std::atomic<bool>& stop);

} // namespace hopmesh::networks
