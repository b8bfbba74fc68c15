// Choosing a rival by name, and what all of them share.
#include "sim/rivals/all_integrators.h"

#include "sim/input/input_error.h"

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
    {"xpbd", "springs as constraints, met in turn", xpbd},
    {"projective_dynamics", "backward Euler by local and global solves", projective_dynamics},
};

// Far beyond any motion a scene describes, far below where squares overflow and infinities breed NaN.
constexpr double lost_speed = 1e30;

void expect(bool good, const std::string& key, double found, const std::string& expected) {
  if (!good) throw input::input_error("", 0, key, std::to_string(found), expected);
}

void check(double time_step, const Options& options) {
  expect(time_step > 0 && std::isfinite(time_step), "time_step", time_step, "a positive number");
  expect(options.tolerance > 0, "tolerance", options.tolerance, "a positive number");
  expect(options.max_iterations > 0, "max_iterations", options.max_iterations, "at least 1");
  expect(options.substeps > 0, "substeps", options.substeps, "at least 1");
  expect(options.iterations >= 0, "iterations", options.iterations, "at least 1, or 0 for the method's own");
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
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
}

void Method::go_on_from(const State& now, const State*) {
  start_from(now);
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
  throw input::input_error("", 0, "method", input::in_quotes(name), "one of " + list(names()),
                           input::nearest_name(name, names()));
}

} // namespace

const char* about(const std::string& name) {
  return row_named(name).words;
}

std::unique_ptr<Method> make_method(const std::string& name, const Physics& physics, double time_step,
                                    const Options& options) {
  check(time_step, options);
  return row_named(name).make(physics, time_step, options);
}

} // namespace hopmesh::rivals
