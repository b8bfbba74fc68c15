// Choosing a rival by name, and what all of them share.
#include "sim/rivals/all_integrators.h"

#include <cmath>

namespace hopmesh::rivals {
namespace {

struct Row {
  std::string name;
  const char* words;
  std::unique_ptr<Method> (*make)(const Physics&, double, const Options&);
};

const std::vector<Row> rows = {
    {"symplectic_euler", "explicit, order 1: velocities, then places by the new ones", symplectic_euler},
    {"velocity_verlet", "explicit, order 2: half a kick, a drift, half a kick", velocity_verlet},
    {"rk4", "explicit, order 4: the classical Runge-Kutta method", rk4},
    {"backward_euler", "implicit, order 1: each step solved by Newton's method", backward_euler},
    {"bdf2", "implicit, order 2: looks two steps back, solved by Newton's method", bdf2},
    {"linearly_implicit", "implicit, order 1: each step linearised, solved by conjugate gradients",
     linearly_implicit},
    {"xpbd", "springs as constraints, met in turn", xpbd},
    {"projective_dynamics", "backward Euler by local and global solves", projective_dynamics},
};

// Far beyond any motion a scene describes, far below where squares overflow and infinities breed NaN.
constexpr double lost_speed = 1e30;

bool in_range(double time_step, const Options& options) {
  return time_step > 0 && std::isfinite(time_step) && options.tolerance >= 0 && options.max_iterations > 0 &&
         options.substeps > 0 && options.iterations >= 0;
}

} // namespace

void Method::advance() {
  step();
  ++counters_.steps;
  // Written so that NaN fails too.
  if (!(state_.velocity.squaredNorm() < lost_speed * lost_speed)) diverge("its speeds left all bounds");
}

void Method::start_from(const State& state) {
  state_ = state;
  before_.reset();
}

void Method::go_on_from(const State& now, const State* before) {
  start_from(now);
  if (before) before_ = *before;
}

void Method::diverge(const std::string& how) const {
  throw LostMotion(name_ + " diverged in step " + std::to_string(counters_.steps) + " with a time step of " +
                   std::to_string(time_step_) + " s: " + how + ".");
}

const std::vector<std::string>& names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> result;
    for (const Row& row : rows) result.push_back(row.name);
    return result;
  }();
  return all;
}

namespace {

const Row& row_named(const std::string& name) {
  for (const Row& row : rows)
    if (row.name == name) return row;
  throw std::invalid_argument("no rival is named " + name);
}

} // namespace

const char* about(const std::string& name) {
  return row_named(name).words;
}

std::unique_ptr<Method> make_method(const std::string& name, const Physics& physics, double time_step,
                                    const Options& options) {
  if (!in_range(time_step, options)) throw std::invalid_argument("a time step or an option out of range");
  return row_named(name).make(physics, time_step, options);
}

} // namespace hopmesh::rivals
