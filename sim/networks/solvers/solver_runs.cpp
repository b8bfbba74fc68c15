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
constexpr double lowered = 0.99;   // of the gap: a fall that counts where a course goes on to its rest
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
    course_.name = name;
    course_.reached.resize(limits.gaps.size());
    course_.lowest = now_ = before_ = problem.start;
  }

  Course run(const std::atomic<bool>& stop) {
    try {
      timed([&] { solver_ = make_(); });
      while (!stop && course_.failure.empty() && !done()) one_sweep();
      if (course_.reached.back()) course_.failure.clear();
    } catch (const Unfit& why) {
      course_.failure = why.what();
    }
    if (solver_) course_.factorisations = solver_->factorisations();
    return std::move(course_);
  }

 private:
  bool done() const { return course_.reached.back() && !limits_.to_rest; }

  template <typename Work> void timed(Work work) {
    const double began = processor_seconds();
    work();
    course_.seconds += processor_seconds() - began;
  }

  void one_sweep() {
    if (course_.sweeps == limits_.max_sweeps)
      return fail(fmt::format("not there after {} sweeps", course_.sweeps));
    timed([&] { solver_->sweep(); });
    ++course_.sweeps;
    judge(gap(problem_, answer_, solver_->V()) / answer_.start_gap);
    watch(solver_->V());
  }

  void judge(double gap) {
    if (gap > gap_ + noise) ++course_.rises;
    if (gap < course_.least_gap)
      course_.least_gap = gap, course_.lowest = solver_->V(), course_.least_sweep = course_.sweeps;
    for (std::size_t k = 0; k < limits_.gaps.size(); ++k)
      if (!course_.reached[k] && gap <= limits_.gaps[k])
        course_.reached[k] = Reached{course_.sweeps, course_.seconds};
    const auto sweep = static_cast<double>(course_.sweeps);
    if (course_.laps.empty() || done() || sweep >= sparser * static_cast<double>(course_.laps.back().sweep))
      course_.laps.push_back({course_.sweeps, gap});
    if (gap < lowered * lower_gap_) lower_gap_ = gap, lower_at_ = course_.sweeps;
    gap_ = gap;
  }

  // A fall that goes on is neither a rest nor a cycle, however slow.
  void watch(const Vector& V) {
    const double moved = distance(V, now_);
    if (!std::isfinite(moved))
      fail("diverges");
    else if (done())
      return;
    else if (limits_.to_rest && course_.sweeps > 2 * lower_at_ + patience)
      fail(fmt::format("no lower since sweep {}", lower_at_));
    else if (moved <= standing)
      fail(fmt::format("at rest after {} sweeps{}", course_.sweeps,
                       answer_.convex ? "" : " in another minimum"));
    else if (moved > moving && distance(V, before_) <= same * moved)
      fail(fmt::format("a 2-cycle after {} sweeps", course_.sweeps));
    before_.swap(now_);
    now_ = V;
  }

  void fail(std::string how) {
    how += fmt::format(" at a gap of {:.2g}", gap_);
    if (course_.rises > 0)
      how += fmt::format("; the energy rose in {:.0f} % of the sweeps",
                         100 * static_cast<double>(course_.rises) / static_cast<double>(course_.sweeps));
    course_.failure = std::move(how);
  }

  const MakeSolver& make_;
  const Problem& problem_;
  const Answer& answer_;
  const Limits& limits_;
  Course course_;
  std::unique_ptr<Solver> solver_;
  Vector now_, before_;
  double gap_ = 1, lower_gap_ = 1; ///< now; at the last fall that counts
  std::uint64_t lower_at_ = 0;
};

const Course* lower_than_answer(const std::vector<Course>& courses) {
  const Course* lowest = nullptr;
  for (const Course& course : courses)
    if (course.least_gap < -1e-9 && (!lowest || course.least_gap < lowest->least_gap)) lowest = &course;
  return lowest;
}

} // namespace

Course run_solver(const std::string& name, const Problem& problem, const Answer& answer, const Limits& limits,
                  const std::atomic<bool>& stop) {
  const auto make = [&] { return make_solver(name, problem, answer.convex); };
  return run_solver(name, make, problem, answer, limits, stop);
}

Course run_solver(const std::string& name, const MakeSolver& make, const Problem& problem,
                  const Answer& answer, const Limits& limits, const std::atomic<bool>& stop) {
  return Runner(name, make, problem, answer, limits).run(stop);
}

// A lower answer moves every gap, and a solver may go on further for it: so all run again.
Race race(const Problem& problem, const Limits& limits, const std::atomic<bool>& stop) {
  constexpr int most_rounds = 5;
  Race race{best_answer(problem), {}};
  if (!(race.answer.start_gap > 0)) return race;
  for (int round = 0; round < most_rounds && !stop; ++round) {
    race.courses.clear();
    for (const std::string& name : solver_names())
      race.courses.push_back(run_solver(name, problem, race.answer, limits, stop));
    const Course* lower = race.answer.convex ? nullptr : lower_than_answer(race.courses);
    if (!lower) break;
    race.answer = answer_below(problem, lower->lowest);
  }
  return race;
}

} // namespace hopmesh::solvers
