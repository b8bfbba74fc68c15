#include "sim/networks/array_solver.h"

#include "sim/networks/solvers/factor.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::networks {

namespace {

using solvers::Vector;

/// use(place in the weight memory, row, column) for every weight, neurons numbered over all nodes.
template <typename Use> void each_weight(const hm_mesh& m, Use use) {
  for (std::uint32_t c = 0; c < m.cells; ++c)
    for (std::uint32_t p = 0; p < m.components; ++p)
      for (std::uint32_t t = 0; t < hm_row_length(&m, c); ++t) {
        const std::uint32_t from = t < m.components ? c : m.link_to[m.first_link[c] + t / m.components - 1];
        use(hm_row_offset(&m, c, p) + t, m.node_of_cell[c] * m.components + p,
            m.node_of_cell[from] * m.components + t % m.components);
      }
}

/// Entries of the cells' neurons of a vector over all nodes.
std::vector<double> by_cell(const hm_mesh& m, const Vector& all) {
  std::vector<double> values;
  for (std::uint32_t c = 0; c < m.cells; ++c)
    for (std::uint32_t p = 0; p < m.components; ++p)
      values.push_back(all[m.node_of_cell[c] * m.components + p]);
  return values;
}

Vector over_all(const levels::BuiltMesh& mesh, const std::vector<double>& by_cell) {
  const auto all = mesh.by_node(by_cell);
  return Eigen::Map<const Vector>(all.data(), static_cast<Eigen::Index>(all.size()));
}

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
      array_(*port_, prepared.mesh->firmware(), prepared.mesh->topology()) {}

// As the firmware loads it, so that no format is interpreted twice.
void StepArray::load_and_sweep() {
  const hm_mesh& mesh = prepared_.mesh->firmware();
  CellNetwork network{std::vector<double>(hm_weight_count(&mesh)), by_cell(mesh, whole_.I),
                      by_cell(mesh, whole_.start)};
  each_weight(mesh, [&](std::uint32_t place, std::uint32_t row, std::uint32_t column) {
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
  const Vector all = over_all(*prepared_.mesh, array_.outputs());
  Vector V(static_cast<Eigen::Index>(stay.size()));
  for (Eigen::Index k = 0; k < V.size(); ++k) V[k] = all[stay[static_cast<std::size_t>(k)]];
  return V;
}

std::optional<solvers::Problem> StepArray::loaded() const {
  if (!array_.is_loaded() || prepared_.inputs.array.normaliser == spec::Normaliser::prescaled)
    return std::nullopt;
  const std::vector<double> weight = array_.weights();
  solvers::Problem problem = whole_;
  problem.I = over_all(*prepared_.mesh, array_.biases());
  std::vector<Eigen::Triplet<double>> entries;
  each_weight(prepared_.mesh->firmware(), [&](std::uint32_t place, std::uint32_t row, std::uint32_t column) {
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
