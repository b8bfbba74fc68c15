// A solution as people read it, and as V.mtx and summary.json.
#include "sim/files/output_file.h"
#include "sim/input/count_text.h"
#include "sim/levels/eigen_vectors.h"
#include "sim/networks/solution.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hopmesh::networks {

namespace {

std::string ending_of(const Solution& s) {
  const std::string sweeps = "after " + input::with_noun(s.rest.sweeps, "sweep");
  if (s.rest.converged) return "At rest " + sweeps;
  if (s.limit_cycle > 0) return fmt::format("Not at rest {}: limit cycle of {}", sweeps, s.limit_cycle);
  return "Not at rest " + sweeps;
}

} // namespace

std::string text_of(const SolveLabel& label, const GivenNetwork& network, const Solution& s) {
  std::string text = fmt::format(
      "{}: {}, {}; level {}, {}, {}\n", label.network, input::with_noun(network.neurons(), "neuron"),
      input::with_noun(network.weights(), "weight"), label.level, label.rule, label.schedule);
  text += ending_of(s);
  if (s.rest.cycles > 0) text += fmt::format(", {} cycles", input::grouped(s.rest.cycles));
  text += fmt::format("\nEnergy {:.9g}, at the start {:.9g}; KKT residual {:.3g}\n", s.energy,
                      s.energy_at_start, s.kkt);
  if (const auto& c = s.corrected)
    text += fmt::format("{} in {} more, {} refused; residual {:.3g}\n",
                        input::with_noun(c->corrections, "correction"), input::with_noun(c->sweeps, "sweep"),
                        c->refused, c->residual);
  if (s.clipped > 0)
    text += fmt::format("{} weights and biases did not fit their format\n", input::grouped(s.clipped));
  if (s.vanished > 0)
    text += fmt::format("{} too small for the format and became 0: the array solves a network without them\n",
                        s.vanished == 1 ? "1 weight or bias is"
                                        : input::grouped(s.vanished) + " weights and biases are");
  if (!label.verdict.empty()) text += label.verdict + '\n';
  return text;
}

void write_solution(const std::filesystem::path& folder, const SolveLabel& label, const GivenNetwork& network,
                    const Solution& s) {
  files::write_vector(folder / "V.mtx", levels::values_of(s.V));
  nlohmann::ordered_json summary{{"network", label.network},
                                 {"level", label.level},
                                 {"rule", label.rule},
                                 {"schedule", label.schedule},
                                 {"neurons", network.neurons()},
                                 {"weights", network.weights()},
                                 {"sweeps", s.rest.sweeps},
                                 {"converged", s.rest.converged},
                                 {"limit_cycle", s.limit_cycle},
                                 {"cycles", s.rest.cycles},
                                 {"clipped", s.clipped},
                                 {"vanished", s.vanished},
                                 {"energy_at_start", s.energy_at_start},
                                 {"energy", s.energy},
                                 {"kkt_residual", s.kkt},
                                 {"verdict", label.verdict}};
  if (const auto& c = s.corrected)
    summary["corrections"] = {{"kept", c->corrections},
                              {"refused", c->refused},
                              {"sweeps", c->sweeps},
                              {"cycles", c->cycles},
                              {"residual", c->residual}};
  files::write_file(folder / "summary.json",
                    summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n');
}

} // namespace hopmesh::networks
