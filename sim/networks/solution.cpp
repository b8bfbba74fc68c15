#include "sim/networks/solution.h"

#include "sim/files/csv.h"
#include "sim/levels/mover.h"

namespace hopmesh::networks {

namespace {

constexpr std::uint32_t longest_cycle = 16;

// Outputs that come back have come back to everything that the next sweep depends on.
std::uint32_t length_of_cycle(NetworkLevel& level, const Eigen::VectorXd& V) {
  for (std::uint32_t k = 1; k <= longest_cycle; ++k) {
    if (level.sweep() == 0) return 0; // one sweep more was all that rest wanted
    if (level.outputs() == V) return k;
  }
  return 0;
}

} // namespace

Solution solve(const GivenNetwork& network, NetworkLevel& level, bool outputs_decide) {
  Solution solution;
  solution.rest = level.relax();
  solution.clipped = level.clipped();
  solution.vanished = level.vanished();
  solution.V = level.outputs();
  solution.energy_at_start = network.energy(network.start());
  solution.energy = network.energy(solution.V);
  solution.kkt = network.kkt_violation(solution.V);
  if (!solution.rest.converged && outputs_decide) solution.limit_cycle = length_of_cycle(level, solution.V);
  return solution;
}

void refine(const GivenNetwork& network, NetworkLevel& level, std::uint32_t most, Solution& solution) {
  solution.corrected = level.refine(most);
  solution.V = level.outputs();
  solution.energy = network.energy(solution.V);
  solution.kkt = network.kkt_violation(solution.V);
}

void write_sweeps(const std::filesystem::path& file, const GivenNetwork& network, NetworkLevel& level,
                  const Solution& solution, const std::atomic<bool>& stop) {
  files::CsvWriter table(file, {"sweep", "energy", "loaded_energy", "largest_change"});
  const auto add = [&](std::uint32_t sweep, double change) {
    table.cell(sweep).cell(network.energy(level.outputs())).cell(level.loaded_energy());
    table.cell(change).end_row();
  };
  level.restart();
  add(0, 0);
  for (std::uint32_t sweep = 1; sweep <= solution.rest.sweeps; ++sweep) {
    if (stop) throw levels::Stopped();
    const double change = level.sweep();
    add(sweep, change);
  }
  if (level.outputs() != solution.V) throw std::logic_error("sweep by sweep the outputs end elsewhere");
  table.commit();
}

} // namespace hopmesh::networks
