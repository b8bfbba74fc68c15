#include "sim/networks/array_solver.h"

#include "sim/levels/eigen_vectors.h"
#include "sim/levels/multiplies.h"
#include "sim/levels/networks/corrections.h"
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
  std::optional<solvers::HardwareWork> hardware() const override { return array_.work(); }

 private:
  StepArray& array_;
};

class CorrectedArray : public solvers::Solver {
 public:
  CorrectedArray(const solvers::Problem& problem, const solvers::Problem& whole, StepArray& array)
      : Solver(problem), array_(array), network_{whole.W, whole.I}, start_(whole.start),
        stay_(solvers::reached_neurons(whole)) {}

  // The first is the array's answer, the others are its corrections.
  void sweep() override {
    if (corrections_) {
      corrections_->correct(whole_);
    } else {
      array_.rest();
      whole_ = array_.whole_outputs();
      corrections_.emplace(network_, array_.room(), [this](const Vector& bias, const Vector& output) {
        return array_.rest_beside(bias, output);
      });
      corrections_->learn_from(start_, whole_);
    }
    for (Eigen::Index k = 0; k < V_.size(); ++k) V_[k] = whole_[stay_[static_cast<std::size_t>(k)]];
  }
  std::optional<solvers::HardwareWork> hardware() const override { return array_.work(); }

 private:
  StepArray& array_;
  const reference::Network network_;
  const Vector start_;
  const std::vector<Eigen::Index> stay_;
  std::optional<levels::Corrections> corrections_;
  Vector whole_;
};

/// To the nearest whole last place.
Vector rounded(const Vector& V, double last_place) {
  return (V / last_place).array().round().matrix() * last_place;
}

} // namespace

StepArray::StepArray(const solvers::Problem& whole, const levels::Prepared& prepared,
                     const spec::ArraySpec& array)
    : whole_(whole), prepared_(prepared), spec_(array),
      port_(levels::default_level().make_port(array, prepared.mesh->topology(), {})),
      array_(*port_, *prepared.mesh) {}

// As the firmware loads it, so that no format is interpreted twice.
levels::CellNetwork StepArray::network() const {
  const levels::BuiltMesh& mesh = *prepared_.mesh;
  levels::CellNetwork network{std::vector<double>(mesh.topology().weight_words()), mesh.by_cell(whole_.I),
                              mesh.by_cell(whole_.start)};
  mesh.each_weight([&](std::size_t place, std::uint32_t row, std::uint32_t column) {
    network.weight[place] = whole_.W.coeff(row, column);
  });
  return network;
}

void StepArray::expect_steps() const {
  if (spec_.output == spec::Output::binary)
    throw solvers::Unfit("its outputs are binary, no step towards this answer");
}

void StepArray::open() {
  const std::vector<double>& m = prepared_.inputs.scene.relax.momentum;
  array_.open();
  if (spec::has_momentum(spec_) && !m.empty()) array_.put_momentum(m);
}

// Two sweeps and one: what a further one takes.
void StepArray::load_and_sweep() {
  open();
  const std::uint64_t two = array_.relax(network(), 0, 2).cycles, before = array_.bus_cycles();
  const spec::Relaxation one = array_.relax(network(), 0, 1);
  a_sweep_ = two > one.cycles ? two - one.cycles : one.cycles;
  count(one, array_.bus_cycles() - before);
}

void StepArray::count(const spec::Relaxation& run, std::uint64_t bus_cycles) {
  work_.sweeps += run.sweeps;
  work_.array_cycles += run.cycles, work_.bus_cycles += bus_cycles;
  set_seconds();
}

void StepArray::set_seconds() {
  work_.multiplies = work_.sweeps * levels::multiplies_a_sweep(spec_, prepared_.mesh->topology());
  work_.seconds = static_cast<double>(work_.array_cycles + work_.bus_cycles) / (spec_.clock_mhz * 1e6);
}

void StepArray::sweep() {
  expect_steps();
  if (!array_.is_loaded()) return load_and_sweep();
  constexpr std::uint64_t sparser =
      100; // each run anew: a hundredth further, where that is more than a sweep
  const std::uint64_t more = spec::has_momentum(spec_) ? 1 + work_.sweeps / sparser : 1;
  array_.sweep(static_cast<std::uint32_t>(more));
  work_.sweeps += more, work_.array_cycles += more * a_sweep_;
  set_seconds();
}

spec::Relaxation StepArray::rest() {
  expect_steps();
  const scene::RelaxSpec& relax = prepared_.inputs.scene.relax;
  open();
  if (relax.stop == scene::Stop::sum) array_.stop_by_share(relax.share);
  const std::uint64_t before = array_.bus_cycles();
  const spec::Relaxation run =
      array_.relax(network(), relax.threshold, static_cast<std::uint32_t>(relax.max_sweeps));
  count(run, array_.bus_cycles() - before);
  return run;
}

Vector StepArray::rest_beside(const Vector& bias, const Vector& output) {
  const levels::BuiltMesh& mesh = *prepared_.mesh;
  const scene::RelaxSpec& relax = prepared_.inputs.scene.relax;
  const std::uint64_t before = array_.bus_cycles();
  const spec::Relaxation run = array_.correct(mesh.by_cell(bias), mesh.by_cell(output), relax.threshold,
                                              static_cast<std::uint32_t>(relax.max_sweeps));
  count(run, array_.bus_cycles() - before);
  return whole_outputs();
}

Vector StepArray::whole_outputs() const {
  return levels::vector_of(prepared_.mesh->by_node(array_.outputs()));
}

Vector StepArray::outputs() const {
  const auto stay = solvers::reached_neurons(whole_);
  const Vector all = whole_outputs();
  Vector V(static_cast<Eigen::Index>(stay.size()));
  for (Eigen::Index k = 0; k < V.size(); ++k) V[k] = all[stay[static_cast<std::size_t>(k)]];
  return V;
}

std::optional<solvers::Problem> StepArray::loaded() const {
  if (!array_.is_loaded() || spec_.normaliser == spec::Normaliser::prescaled) return std::nullopt;
  const std::vector<double> weight = array_.weights();
  solvers::Problem problem = whole_;
  problem.I = levels::vector_of(prepared_.mesh->by_node(array_.biases()));
  std::vector<Eigen::Triplet<double>> entries;
  prepared_.mesh->each_weight([&](std::size_t place, std::uint32_t row, std::uint32_t column) {
    entries.emplace_back(row, column, weight[place]);
  });
  problem.W.setFromTriplets(entries.begin(), entries.end());
  return problem;
}

solvers::SolverRun run_array(const std::string& name, StepArray& array, const solvers::Problem& problem,
                             const solvers::Answer& answer, solvers::Limits limits,
                             const std::atomic<bool>& stop) {
  limits.to_rest = true;
  const auto make = [&] { return std::make_unique<ArraySolver>(problem, array); };
  return solvers::run_solver(name, make, problem, answer, limits, stop);
}

solvers::SolverRun run_corrected(const std::string& name, StepArray& array, const solvers::Problem& whole,
                                 const solvers::Problem& problem, const solvers::Answer& answer,
                                 const solvers::Limits& limits, const std::atomic<bool>& stop) {
  const auto make = [&] { return std::make_unique<CorrectedArray>(problem, whole, array); };
  return solvers::run_solver(name, make, problem, answer, limits, stop);
}

std::string stall_text(const StepArray& array, const solvers::SolverRun& solver_run,
                       const solvers::Problem& problem, const solvers::Answer& answer) {
  if (solver_run.sweeps == 0) return "";
  const double place = array.last_place();
  const Vector off = (solver_run.lowest - answer.V) / place;
  const auto share = [&](const Vector& V) { return gap(problem, answer, V) / answer.start_gap; };
  std::string text = fmt::format(
      "{}: lowest after {} of {} sweeps, at a gap of {:.2g}; there outputs are off by {:.3g} last places "
      "of {:.2g} at most, {:.3g} rms\n",
      solver_run.name, solver_run.least_sweep, solver_run.sweeps, solver_run.least_gap,
      off.lpNorm<Eigen::Infinity>(), place, off.norm() / std::sqrt(static_cast<double>(off.size())));
  text +=
      fmt::format("  the answer in whole last places has a gap of {:.2g}", share(rounded(answer.V, place)));
  auto loaded = array.loaded();
  if (loaded) loaded = solvers::reached(*loaded);
  if (loaded && loaded->I.size() == problem.I.size() && solvers::is_convex(*loaded))
    text +=
        fmt::format(", that of the weights as loaded one of {:.2g}", share(solvers::best_answer(*loaded).V));
  return text + fmt::format("; {} cycles a sweep\n", array.cycles_per_sweep());
}

} // namespace hopmesh::networks
