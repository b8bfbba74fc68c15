#include "sim/study/stability_class.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::study {

namespace {

using Rows = std::vector<levels::StepRow>;

/// The mean of a figure over the k-th quarter of the rows, k = 0..3.
template <typename Figure> double quarter(const Rows& rows, std::size_t k, Figure figure) {
  const std::size_t from = rows.size() * k / 4, to = rows.size() * (k + 1) / 4;
  double sum = 0;
  for (std::size_t r = from; r < to; ++r) sum += figure(rows[r]);
  return sum / static_cast<double>(to - from);
}

template <typename Holds> bool mostly(const Rows& rows, Holds holds) {
  const auto count = std::count_if(rows.begin(), rows.end(), holds);
  return static_cast<double>(count) > most_of * static_cast<double>(rows.size());
}

bool gains_energy(const Rows& rows) {
  const auto total = [](const levels::StepRow& r) { return r.energy + r.kinetic; };
  return rows.size() >= least_rows && quarter(rows, 3, total) > gain_factor * quarter(rows, 2, total);
}

bool is_saturated(const Rows& rows, std::size_t outputs) {
  return mostly(rows, [outputs](const levels::StepRow& r) {
    return static_cast<double>(r.saturated) > most_of * static_cast<double>(outputs);
  });
}

// What ended a step does not matter: starved of sweeps, or at rest for its own words only.
bool leaves(const levels::StepRow& r, double share) {
  return r.fall_left && *r.fall_left > share;
}

bool stalls(const Rows& rows) {
  return mostly(rows, [](const levels::StepRow& r) { return r.converged && leaves(r, stall_share); });
}

// Friction leaves a velocity `friction` a step, an energy its square.
bool is_over_damped(const Rows& rows, double friction) {
  if (rows.size() < least_rows) return false;
  const auto kinetic = [](const levels::StepRow& r) { return r.kinetic; };
  const auto peak =
      std::max_element(rows.begin(), rows.end(), [](const levels::StepRow& a, const levels::StepRow& b) {
        return a.kinetic < b.kinetic;
      });
  const double left = std::pow(friction, 2.0 * static_cast<double>(rows.end() - peak));
  return peak->kinetic > 0 && quarter(rows, 3, kinetic) < damped_share * left * peak->kinetic;
}

} // namespace

Stability classify(const Rows& rows, const StabilityFacts& facts) {
  if (facts.diverged) return Stability::blow_up;
  if (gains_energy(rows)) return Stability::energy_gain;
  if (mostly(rows, [](const levels::StepRow& r) { return r.alternation > cycle_share; }))
    return Stability::limit_cycle;
  if (is_saturated(rows, facts.outputs)) return Stability::saturated;
  if (stalls(rows)) return Stability::lattice_stall;
  if (mostly(rows, [](const levels::StepRow& r) { return leaves(r, soft_share); }))
    return Stability::falsely_soft;
  if (is_over_damped(rows, facts.friction)) return Stability::over_damped;
  return Stability::stable;
}

} // namespace hopmesh::study
