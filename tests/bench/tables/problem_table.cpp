// The problem set in one table, for docs/findings/problem-set.md: the program at every level beside answers
// that no neuron found, and the pictures of that page. `problem_table PROGRAM FOLDER [pictures|table]`
#include "sim/files/output_file.h"
#include "tests/bench/tables/network_pictures.h"
#include "tests/support/box_solver.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::bench {
namespace {

using problems::Problem;

constexpr int starts = 20;
constexpr std::size_t most_weights_for_systemc = 150'000; // a cell and a link a coupling: memory
constexpr std::size_t most_neurons_for_starts = 400;

struct Exact {
  double energy;
  const char* by;
};

bool has_many_starts(const Problem& p) {
  if (p.W.rows > most_neurons_for_starts) return false;
  const auto& names = problems::names();
  return std::count(names.begin(), names.end(), p.name) > 0 && problems::make(p.name, 2).start != p.start;
}

bool is_convex(const Problem& p) {
  return p.name.rfind("box-", 0) == 0 && p.name.rfind("box-corner", 0) != 0;
}

std::optional<Exact> exact_of(const Problem& p) {
  if (p.least_energy) return Exact{*p.least_energy, "known"};
  if (p.W.rows <= 24) return Exact{tests::least_at_corners(p.W, p.bias), "all corners"};
  if (p.binary) return std::nullopt;
  const tests::BoxAnswer answer = tests::least_on_box(p.W, p.bias, p.start, 1e-11, 20'000);
  return Exact{answer.energy, !answer.solved ? "solver, not at rest"
                              : is_convex(p) ? "solver"
                                             : "solver, from the same start"};
}

/// Of many starts: the least energy found, and how often it is the exact one (as outputs near bounds have
/// it).
std::string of_many(const ProblemRuns& runs, const Problem& p, const std::optional<Exact>& exact) {
  double least = 0;
  int exactly = 0;
  std::string best;
  for (int seed = 1; seed <= starts; ++seed) {
    const Solved s = runs.solve(p.name, "engine", fmt::format("--seed {}", seed));
    if (seed == 1 || s.energy < least) least = s.energy, best = s.verdict;
    exactly += exact && s.energy <= exact->energy + 0.1;
  }
  const std::string often = exact ? fmt::format(", the least in {} of {}", exactly, starts) : "";
  return fmt::format("best of {}: {}{}", starts, best, often);
}

void print_row(const ProblemRuns& runs, const Problem& p, const std::string& what) {
  const Solved engine = runs.solve(what, "engine");
  std::string equal = "not run";
  if (p.W.entries.size() <= most_weights_for_systemc) {
    const Solved systemc = runs.solve(what, "systemc");
    equal = systemc.V == engine.V && systemc.cycles == engine.cycles ? "yes" : "NO";
  }
  const Solved reference = runs.solve(what, "reference");
  const auto exact = exact_of(p);
  const std::string remark = has_many_starts(p) ? of_many(runs, p, exact) : engine.verdict;
  const std::string gap =
      exact ? fmt::format("{:.2g} | {}", (engine.energy - exact->energy) / std::abs(exact->energy), exact->by)
            : "– | none known";
  fmt::print("| `{}` | {} | {} | {}{} / {} | {:.7g} | {:.7g} | {} | {} | {} |\n", p.name, p.W.rows,
             p.W.entries.size(), engine.sweeps, engine.converged ? "" : "…", reference.sweeps, engine.energy,
             reference.energy, gap, equal, remark);
  std::fflush(stdout);
}

void print_table(const ProblemRuns& runs) {
  fmt::print("| problem | neurons | weights | sweeps: engine / reference | energy: engine | reference | gap "
             "of the engine | to | engine = systemc | |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& name : problems::names()) print_row(runs, problems::make(name), name);
  for (const auto& [scene, step] : {std::pair("flag-225", 5), {"flag-400", 20}, {"banner", 10}}) {
    std::string what;
    const Problem p = runs.network(scene, step, what);
    print_row(runs, p, what);
  }
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  using namespace hopmesh;
  const std::string part = argc > 3 ? argv[3] : "";
  if (argc < 3 || (!part.empty() && part != "pictures" && part != "table"))
    return fmt::print(stderr, "usage: problem_table PROGRAM FOLDER [pictures|table]\n"), 2;
  const std::filesystem::path folder(argv[2]);
  std::filesystem::create_directories(folder);
  const bench::ProblemRuns runs(argv[1], folder);
  if (part != "table") files::write_file(folder / "recall.png", bench::recall_picture(runs));
  if (part != "table") files::write_file(folder / "diagonal.svg", bench::diagonal_chart(runs));
  if (part != "pictures") bench::print_table(runs);
}
