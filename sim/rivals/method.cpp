// Choosing a rival by name, and what all of them share.
#include "sim/rivals/methods.h"

#include "sim/input/input_error.h"

#include <cmath>

namespace hopmesh::rivals {
namespace {

using Maker = std::unique_ptr<Method> (*)(const Physics&, double, const Options&);

const std::vector<std::pair<std::string, Maker>> makers = {
    {"symplectic_euler", symplectic_euler},
    {"velocity_verlet", velocity_verlet},
    {"rk4", rk4},
    {"backward_euler", backward_euler},
    {"bdf2", bdf2},
    {"xpbd", xpbd},
    {"projective_dynamics", projective_dynamics},
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
  throw Diverged(name_ + " diverged in step " + std::to_string(counters_.steps) + " with a time step of " +
                 std::to_string(time_step_) + " s: " + how + ".");
}

const std::vector<std::string>& names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> result;
    for (const auto& [name, maker] : makers) result.push_back(name);
    return result;
  }();
  return all;
}

std::unique_ptr<Method> make_method(const std::string& name, const Physics& physics, double time_step,
                                    const Options& options) {
  check(time_step, options);
  for (const auto& [known, maker] : makers)
    if (known == name) return maker(physics, time_step, options);
  throw input::input_error("", 0, "method", input::in_quotes(name), "one of " + list(names()),
                           input::nearest_name(name, names()));
}

} // namespace hopmesh::rivals
