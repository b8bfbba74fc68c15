#include "sim/networks/certainty.h"

#include "sim/levels/networks/told_error.h"
#include "sim/networks/solvers/answer.h"

#include <cmath>
#include <fmt/format.h>

namespace hopmesh::networks {

namespace {

using solvers::Vector;

double rms(const Vector& V) {
  return V.size() > 0 ? V.norm() / std::sqrt(static_cast<double>(V.size())) : 0;
}

Vector of_reached(const solvers::Problem& problem, const Vector& V) {
  const auto stay = solvers::reached_neurons(problem);
  Vector part(static_cast<Eigen::Index>(stay.size()));
  for (Eigen::Index k = 0; k < part.size(); ++k) part[k] = V[stay[static_cast<std::size_t>(k)]];
  return part;
}

std::string case_of(const levels::ErrorBound& bound) {
  std::string text = bound.link_is_state ? "link = state" : "the link is coarser than the state";
  text += bound.each ? ", input by input" : ", by the least curvature";
  return text + (bound.proved
                     ? ", proved"
                     : ", if the sweep before the last moved outputs by at most twice the threshold");
}

} // namespace

Certainty certainty_of(const solvers::Problem& problem, const Vector& V, const levels::ErrorBounds& bounds,
                       const spec::ArraySpec& array, const std::optional<levels::RunRules>& rules) {
  Certainty certainty;
  const solvers::Problem reached = solvers::reached(problem);
  const Vector part = of_reached(problem, V);
  certainty.measured = rms(part - solvers::best_answer(reached).V);
  if (!bounds.definite()) return certainty;
  if (const auto told = levels::told_error({problem.W, problem.I}, V)) {
    certainty.told = told->rms(static_cast<std::size_t>(part.size()));
    certainty.held = told->held + told->stopped;
  }
  if (rules) certainty.bound = bounds.of(array, *rules);
  if (certainty.bound && certainty.held > 0) certainty.bound->each.reset();
  return certainty;
}

std::string bound_text(const std::optional<levels::ErrorBound>& bound) {
  if (!bound) return "no bound is claimed beforehand";
  return fmt::format("beforehand at most {:.3g} ({})", bound->least(), case_of(*bound));
}

std::string told_text(const Certainty& c) {
  std::string text = fmt::format("{:.3g} rms from the answer", c.measured);
  if (!c.told) return text + "; the network is not definite: one solve tells nothing";
  text += fmt::format("; one solve tells {:.3g}", *c.told);
  return c.held > 0 ? text + fmt::format(" (an estimate: outputs held at bounds: {})", c.held) : text;
}

} // namespace hopmesh::networks
