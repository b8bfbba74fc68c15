// Names, and what each stands for.
#include "sim/networks/solvers/all_solvers.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace hopmesh::solvers {
namespace {

Order one_by_one(const Problem& problem) {
  Order order;
  for (Eigen::Index i = 0; i < problem.I.size(); ++i) order.push_back({static_cast<std::uint32_t>(i)});
  return order;
}

/// All x, then all y, all z.
Order by_component(const Problem& problem) {
  Order order = one_by_one(problem);
  std::stable_sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    return problem.component[a[0]] < problem.component[b[0]];
  });
  return order;
}

Order all_at_once(const Problem& problem) {
  Order order(1, std::vector<std::uint32_t>(problem.I.size()));
  std::iota(order[0].begin(), order[0].end(), 0u);
  return order;
}

struct Entry {
  std::string name;
  bool any_problem; ///< else convex ones only
  std::function<std::unique_ptr<Solver>(const Problem&)> make;
};

using P = const Problem&;

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {"hopfield_coloured", true, [](P p) { return make_neurons(p, Rule::hopfield, 1, p.colours); }},
      {"hopfield_sequential", true, [](P p) { return make_neurons(p, Rule::hopfield, 1, one_by_one(p)); }},
      {"hopfield_synchronous", true, [](P p) { return make_neurons(p, Rule::hopfield, 1, all_at_once(p)); }},
      {"hopfield_damped", true, [](P p) { return make_neurons(p, Rule::hopfield, 0.5, all_at_once(p)); }},
      {"jacobi", true, [](P p) { return make_neurons(p, Rule::exact, 1, all_at_once(p)); }},
      {"jacobi_damped", true, [](P p) { return make_neurons(p, Rule::exact, 0.5, all_at_once(p)); }},
      {"gauss_seidel", true, [](P p) { return make_neurons(p, Rule::exact, 1, one_by_one(p)); }},
      {"sor_1.8_sequential", true, [](P p) { return make_neurons(p, Rule::exact, 1.8, one_by_one(p)); }},
      {"sor_1.8_by_component", true, [](P p) { return make_neurons(p, Rule::exact, 1.8, by_component(p)); }},
      {"accelerated_gradient", false, make_accelerated_gradient},
      {"conjugate_gradient", false, make_conjugate_gradient},
      {"admm_tenth", false, [](P p) { return make_admm(p, 0.1); }},
      {"admm_hundredth", false, [](P p) { return make_admm(p, 0.01); }},
      {"projected_newton", false, make_projected_newton},
      {"cholesky", false, make_cholesky},
  };
  return all;
}

} // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Entry& entry : entries()) all.push_back(entry.name);
    return all;
  }();
  return names;
}

std::unique_ptr<Solver> make_solver(const std::string& name, const Problem& problem, bool convex) {
  for (const Entry& entry : entries()) {
    if (entry.name != name) continue;
    if (!entry.any_problem && !convex)
      throw Unfit("needs a convex energy; the curvature here is not positive everywhere");
    return entry.make(problem);
  }
  throw std::invalid_argument("no solver is named " + name);
}

} // namespace hopmesh::solvers
