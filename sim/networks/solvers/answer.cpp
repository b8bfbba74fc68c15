#include "sim/networks/solvers/answer.h"

#include "sim/networks/solvers/factor.h"
#include "sim/networks/solvers/network_solver.h"

namespace hopmesh::solvers {
namespace {

constexpr double at_rest = 1e-12;
constexpr int most_factorisations = 1000, most_descents = 100000;

void sweep_to_rest(Solver& solver, const Problem& problem, int most) {
  for (int k = 0; k < most && kkt_violation(problem, solver.V()) > at_rest; ++k) solver.sweep();
}

Answer answer_at(const Problem& problem, const Vector& V, bool convex) {
  Answer answer{V, inputs(problem, V), convex, 0};
  answer.start_gap = gap(problem, answer, problem.start);
  return answer;
}

} // namespace

Answer best_answer(const Problem& problem) {
  const bool convex = is_convex(problem);
  if (!convex) return answer_below(problem, problem.start);
  const auto solver = make_solver("projected_newton", problem, convex);
  sweep_to_rest(*solver, problem, most_factorisations);
  if (kkt_violation(problem, solver->V()) > at_rest)
    throw std::runtime_error("the exact answer was not found");
  return answer_at(problem, solver->V(), convex);
}

Answer answer_below(const Problem& problem, const Vector& V) {
  Problem from = problem;
  from.start = V;
  const auto solver = make_solver("hopfield_sequential", from, false);
  sweep_to_rest(*solver, from, most_descents);
  return answer_at(problem, solver->V(), false);
}

double gap(const Problem& problem, const Answer& answer, const Vector& V) {
  return rise(problem, answer.s, V - answer.V);
}

} // namespace hopmesh::solvers
