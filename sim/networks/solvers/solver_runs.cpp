#include "sim/networks/solvers/solver_runs.h"

#include <cmath>
#include <ctime>
#include <fmt/format.h>

namespace hopmesh::solvers {
namespace {

constexpr double sparser = 1.05;   // laps kept: each this much later than the one before
constexpr double noise = 1e-13;    // of the start's gap: less is no rise
constexpr double same = 1e-9;      // two states back, against one: a 2-cycle
constexpr double moving = 1e-6;    // an output that moves by less is no part of a cycle
constexpr double standing = 1e-15; // nothing moves any more
constexpr double lowered = 0.99;   // of the gap: a fall that counts where a run goes on to its rest
constexpr std::uint64_t patience = 100;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double distance(const Vector& a, const Vector& b) {
  return (a - b).lpNorm<Eigen::Infinity>();
}

class Runner {
 public:
  Runner(const std::string& name, const MakeSolver& make, const Problem& problem, const Answer& answer,
         const Limits& limits)
      : make_(make), problem_(problem), answer_(answer), limits_(limits) {
    run_.name = name;
    run_.reached.resize(limits.gaps.size());
    run_.lowest = now_ = before_ = problem.start;
  }

  SolverRun run(const std::atomic<bool>& stop) {
    try {
      timed([&] { solver_ = make_(); });
      while (!stop && run_.failure.empty() && !done()) one_sweep();
      if (run_.reached.back()) run_.failure.clear();
    } catch (const Unfit& why) {
      run_.failure = why.what();
    }
    if (solver_) run_.factorisations = solver_->factorisations();
    return std::move(run_);
  }

 private:
  bool done() const { return run_.reached.back() && !limits_.to_rest; }

  template <typename Work> void timed(Work work) {
    const double began = processor_seconds();
    work();
    run_.seconds += processor_seconds() - began;
  }

  void one_sweep() {
    if (run_.sweeps >= limits_.max_sweeps) return fail(fmt::format("not there after {} sweeps", run_.sweeps));
    timed([&] { solver_->sweep(); });
    work_ = solver_->hardware();
    run_.sweeps = work_ ? work_->sweeps : run_.sweeps + 1;
    judge(gap(problem_, answer_, solver_->V()) / answer_.start_gap);
    watch(solver_->V());
  }

  void judge(double gap) {
    if (gap > gap_ + noise) ++run_.rises;
    if (gap < run_.least_gap)
      run_.least_gap = gap, run_.lowest = solver_->V(), run_.least_sweep = run_.sweeps;
    for (std::size_t k = 0; k < limits_.gaps.size(); ++k)
      if (!run_.reached[k] && gap <= limits_.gaps[k])
        run_.reached[k] = Reached{run_.sweeps, run_.seconds, work_};
    const auto sweep = static_cast<double>(run_.sweeps);
    if (run_.samples.empty() || done() || sweep >= sparser * static_cast<double>(run_.samples.back().sweep))
      run_.samples.push_back({run_.sweeps, gap, run_.seconds, work_});
    if (gap < lowered * lower_gap_) lower_gap_ = gap, lower_at_ = run_.sweeps;
    gap_ = gap;
  }

  // A fall that goes on is neither a rest nor a cycle, however slow.
  void watch(const Vector& V) {
    const double moved = distance(V, now_);
    if (!std::isfinite(moved))
      fail("diverges");
    else if (done())
      return;
    else if (limits_.to_rest && run_.sweeps > 2 * lower_at_ + patience)
      fail(fmt::format("no lower since sweep {}", lower_at_));
    else if (moved <= standing)
      fail(
          fmt::format("at rest after {} sweeps{}", run_.sweeps, answer_.convex ? "" : " in another minimum"));
    else if (moved > moving && distance(V, before_) <= same * moved)
      fail(fmt::format("a 2-cycle after {} sweeps", run_.sweeps));
    before_.swap(now_);
    now_ = V;
  }

  void fail(std::string how) {
    how += fmt::format(" at a gap of {:.2g}", gap_);
    if (run_.rises > 0)
      how += fmt::format("; the energy rose in {:.0f} % of the sweeps",
                         100 * static_cast<double>(run_.rises) / static_cast<double>(run_.sweeps));
    run_.failure = std::move(how);
  }

  const MakeSolver& make_;
  const Problem& problem_;
  const Answer& answer_;
  const Limits& limits_;
  SolverRun run_;
  std::unique_ptr<Solver> solver_;
  std::optional<HardwareWork> work_; ///< of it
  Vector now_, before_;
  double gap_ = 1, lower_gap_ = 1; ///< now; at the last fall that counts
  std::uint64_t lower_at_ = 0;
};

const SolverRun* lower_than_answer(const std::vector<SolverRun>& runs) {
  const SolverRun* lowest = nullptr;
  for (const SolverRun& solver_run : runs)
    if (solver_run.least_gap < -1e-9 && (!lowest || solver_run.least_gap < lowest->least_gap))
      lowest = &solver_run;
  return lowest;
}

} // namespace

SolverRun run_solver(const std::string& name, const Problem& problem, const Answer& answer,
                     const Limits& limits, const std::atomic<bool>& stop) {
  const auto make = [&] { return make_solver(name, problem, answer.convex); };
  return run_solver(name, make, problem, answer, limits, stop);
}

SolverRun run_solver(const std::string& name, const MakeSolver& make, const Problem& problem,
                     const Answer& answer, const Limits& limits, const std::atomic<bool>& stop) {
  return Runner(name, make, problem, answer, limits).run(stop);
}

// A lower answer moves every gap, and a solver may go on further for it: so all run again.
SolverRuns solve_with_all(const Problem& problem, const Limits& limits, const std::atomic<bool>& stop) {
  constexpr int most_rounds = 5;
  SolverRuns all{best_answer(problem), {}};
  if (!(all.answer.start_gap > 0)) return all;
  for (int round = 0; round < most_rounds && !stop; ++round) {
    all.runs.clear();
    for (const std::string& name : solver_names())
      if (runs(limits, name)) all.runs.push_back(run_solver(name, problem, all.answer, limits, stop));
    const SolverRun* lower = all.answer.convex ? nullptr : lower_than_answer(all.runs);
    if (!lower) break;
    all.answer = answer_below(problem, lower->lowest);
  }
  return all;
}

} // namespace hopmesh::solvers
