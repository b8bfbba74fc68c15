// Restart rules that no array has, beside the one that it has: sweeps of momentum in double to a gap, on the
// network of one step. docs/findings/output-stages-tried.md has the table.
//
//     restarts SCENE STEP [--set KEY=VALUE]...
#include "sim/levels/interrupt.h"
#include "sim/networks/solvers/solver_runs.h"
#include "sim/networks/step_problem.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::campaigns {
namespace {

using solvers::Vector;

enum class Rule { sign, exact, cell, neuron, none };
constexpr std::pair<const char*, Rule> rules[] = {{"sign", Rule::sign},
                                                  {"exact", Rule::exact},
                                                  {"cell", Rule::cell},
                                                  {"neuron", Rule::neuron},
                                                  {"none", Rule::none}};

double sign(double x) {
  return (x > 0) - (x < 0);
}

/// The stage of docs/hardware/datapath.md in double; a part of the network restarts by its own sum.
class Momentum : public solvers::Solver {
 public:
  Momentum(const solvers::Problem& problem, Rule rule) : Solver(problem), rule_(rule), Y_(V_) {
    N_ = Vector::Zero(V_.size());
    for (Eigen::Index i = 0; i < N_.size(); ++i)
      for (solvers::Weights::InnerIterator w(problem.W, i); w; ++w) N_[i] += std::abs(w.value());
    part_ = parts();
    entry_.assign(static_cast<std::size_t>(V_.size()), 0);
  }

  void sweep() override {
    const Vector s = solvers::inputs(problem_, Y_);
    const Vector u = (s.array() / N_.array()).cwiseMin(1).cwiseMax(-1);
    const Vector next = solvers::into_box(Y_ + u), change = next - V_;
    V_ = next;
    std::vector<double> agreement(static_cast<std::size_t>(V_.size()), 0);
    for (Eigen::Index i = 0; i < V_.size(); ++i)
      agreement[part_[i]] += (rule_ == Rule::exact ? s[i] : sign(s[i])) * change[i];
    for (Eigen::Index i = 0; i < V_.size(); ++i) {
      const bool again = rule_ != Rule::none && agreement[part_[i]] < 0;
      Y_[i] = again ? V_[i] : std::max(-1.0, std::min(1.0, V_[i] + m(entry_[i]) * change[i]));
      entry_[i] = again ? 1 : entry_[i] + 1;
    }
  }

 private:
  /// What restarts together: all, the neurons of a node (which are numbered together), or each by itself.
  std::vector<std::size_t> parts() const {
    std::vector<std::size_t> part(static_cast<std::size_t>(V_.size()), 0);
    for (std::size_t i = 1; i < part.size(); ++i) {
      const bool new_node = problem_.component[i] <= problem_.component[i - 1];
      if (rule_ == Rule::neuron) part[i] = i;
      if (rule_ == Rule::cell) part[i] = part[i - 1] + new_node;
    }
    return part;
  }

  double m(std::size_t entry) {
    while (table_.size() <= entry) {
      const double next = (1 + std::sqrt(1 + 4 * t_ * t_)) / 2;
      table_.push_back((t_ - 1) / next);
      t_ = next;
    }
    return table_[entry];
  }

  const Rule rule_;
  Vector Y_, N_;
  std::vector<std::size_t> part_, entry_;
  std::vector<double> table_;
  double t_ = 1;
};

int restarts(const std::string& scene, int step, const std::vector<std::string>& set) {
  const levels::Prepared p = levels::prepare(scene, "", set);
  levels::ReferenceMover motion(p.inputs.scene, *p.mesh, p.inputs.array);
  for (int k = 0; k < step; ++k) motion.advance();
  const levels::StepState before = motion.state();
  motion.advance();
  const solvers::Problem problem = solvers::reached(networks::step_problem(motion, before, p, {}));
  const solvers::Answer answer = solvers::best_answer(problem);
  fmt::print("{} step {}: sweeps to a gap of 1e-2, 1e-4, 1e-6\n", scene, step);
  for (const auto& [name, rule] : rules) {
    const auto make = [&problem, rule = rule] { return std::make_unique<Momentum>(problem, rule); };
    const solvers::SolverRun found = solvers::run_solver(
        name, make, problem, answer, {{1e-2, 1e-4, 1e-6}, 20'000}, levels::stop_requested);
    fmt::print("{:<8}", name);
    for (const auto& reached : found.reached)
      fmt::print("{:>8}", reached ? std::to_string(reached->sweeps) : "-");
    fmt::print("  {}\n", found.failure);
  }
  return 0;
}

} // namespace
} // namespace hopmesh::campaigns

int main(int argc, char** argv) {
  std::vector<std::string> set;
  for (int k = 3; k + 1 < argc; k += 2) set.emplace_back(argv[k + 1]);
  if (argc < 3) return 2;
  try {
    return hopmesh::campaigns::restarts(argv[1], std::stoi(argv[2]), set);
  } catch (const std::exception& why) {
    fmt::print(stderr, "{}\n", why.what());
    return 2;
  }
}
