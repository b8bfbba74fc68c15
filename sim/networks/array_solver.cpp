#include "sim/networks/array_solver.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/networks/solvers/factor.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::networks {

namespace {

using solvers::Vector;

class ArraySolver : public solvers::Solver {
 public:
  ArraySolver(const solvers::Problem& problem, StepArray& array) : Solver(problem), array_(array) {}

  void sweep() override {
    array_.sweep();
    V_ = array_.outputs();
  }

 private:
  StepArray& array_;
};

/// To the nearest whole last place.
Vector rounded(const Vector& V, double last_place) {
  return (V / last_place).array().round().matrix() * last_place;
}

} // namespace

StepArray::StepArray(const solvers::Problem& whole, const levels::Prepared& prepared)
    : whole_(whole), prepared_(prepared),
      port_(levels::default_level().make_port(prepared.inputs.array, prepared.mesh->topology(), {})),
      array_(*port_, *prepared.mesh) {}

// As the firmware loads it, so that no format is interpreted twice.
void StepArray::load_and_sweep() {
  const levels::BuiltMesh& mesh = *prepared_.mesh;
  levels::CellNetwork network{std::vector<double>(mesh.topology().weight_words()), mesh.by_cell(whole_.I),
                              mesh.by_cell(whole_.start)};
  mesh.each_weight([&](std::size_t place, std::uint32_t row, std::uint32_t column) {
    network.weight[place] = whole_.W.coeff(row, column);
  });
  cycles_ = array_.relax(std::move(network), 0, 1).cycles;
}

void StepArray::sweep() {
  if (prepared_.inputs.array.output == spec::Output::binary)
    throw solvers::Unfit("its outputs are binary, no step towards this answer");
  if (array_.is_loaded())
    array_.sweep();
  else
    load_and_sweep();
}

Vector StepArray::outputs() const {
  const auto stay = solvers::reached_neurons(whole_);
  const Vector all = levels::vector_of(prepared_.mesh->by_node(array_.outputs()));
  Vector V(static_cast<Eigen::Index>(stay.size()));
  for (Eigen::Index k = 0; k < V.size(); ++k) V[k] = all[stay[static_cast<std::size_t>(k)]];
  return V;
}

std::optional<solvers::Problem> StepArray::loaded() const {
  if (!array_.is_loaded() || prepared_.inputs.array.normaliser == spec::Normaliser::prescaled)
    return std::nullopt;
  const std::vector<double> weight = array_.weights();
  solvers::Problem problem = whole_;
  problem.I = levels::vector_of(prepared_.mesh->by_node(array_.biases()));
  std::vector<Eigen::Triplet<double>> entries;
  prepared_.mesh->each_weight([&](std::size_t place, std::uint32_t row, std::uint32_t column) {
    entries.emplace_back(row, column, weight[place]);
  });
  problem.W.setFromTriplets(entries.begin(), entries.end());
  return solvers::reached(problem);
}

solvers::SolverRun run_array(StepArray& array, const solvers::Problem& problem, const solvers::Answer& answer,
                             solvers::Limits limits, const std::atomic<bool>& stop) {
  limits.to_rest = true;
  const auto make = [&] { return std::make_unique<ArraySolver>(problem, array); };
  return solvers::run_solver("array", make, problem, answer, limits, stop);
}

std::string stall_text(const StepArray& array, const solvers::SolverRun& solver_run,
                       const solvers::Problem& problem, const solvers::Answer& answer) {
  if (solver_run.sweeps == 0) return "";
  const double place = array.last_place();
  const Vector off = (solver_run.lowest - answer.V) / place;
  const auto share = [&](const Vector& V) { return gap(problem, answer, V) / answer.start_gap; };
  std::string text = fmt::format(
      "array: lowest after {} of {} sweeps, at a gap of {:.2g}; there outputs are off by {:.3g} last places "
      "of {:.2g} at most, {:.3g} rms\n",
      solver_run.least_sweep, solver_run.sweeps, solver_run.least_gap, off.lpNorm<Eigen::Infinity>(), place,
      off.norm() / std::sqrt(static_cast<double>(off.size())));
  text +=
      fmt::format("  the answer in whole last places has a gap of {:.2g}", share(rounded(answer.V, place)));
  const auto loaded = array.loaded();
  if (loaded && loaded->I.size() == problem.I.size() && solvers::is_convex(*loaded))
    text +=
        fmt::format(", that of the weights as loaded one of {:.2g}", share(solvers::best_answer(*loaded).V));
  return text + fmt::format("; {} cycles a sweep\n", array.cycles_per_sweep());
}

} // namespace hopmesh::networks
