// The rivals' figures against the measured anchors, from the file of bench_rivals
// (docs/findings/array-against-integrators.md, Speed).
#include "tests/bench/tables/bench_results.h"

#include <fmt/format.h>

namespace hopmesh::bench {
namespace {

/// Milliseconds of processor time a simulated second, measured once with -march=native on a machine like this
/// one.
struct Anchor {
  const char* name;
  double milliseconds;
};
constexpr Anchor anchors[] = {
    {"symplectic_euler", 0.63},  {"velocity_verlet", 0.65}, {"rk4", 2.16}, {"xpbd", 14},
    {"projective_dynamics", 53}, {"backward_euler", 397},   {"bdf2", 396}};
constexpr const char* without_anchor[] = {"linearly_implicit"}; ///< their step is that of Newton's
constexpr double yardstick = 478;                               ///< ms a simulated second: CVODE, Adams
constexpr double most_behind = 1.5;

/// Unit costs, s.
struct Unit {
  const char *what, *name, *counter;
  double most;
};
constexpr Unit units[] = {{"velocity Verlet, a step", "velocity_verlet", "s/step", 2.2e-6},
                          {"projective dynamics, an iteration", "projective_dynamics", "s/iteration", 33e-6},
                          {"XPBD, a sweep", "xpbd", "s/iteration", 23e-6}};

double figure(const Results& r, const std::string& name, const std::string& counter) {
  return r.samples("rivals/" + name, counter).least(); // the anchors are the best of several runs, too
}

const char* yes_no(bool met) {
  return met ? "yes" : "no";
}

void print_ratios(const Results& r) {
  fmt::print("\n  {:<22} | {:>10} | {:>12} | {:>9} | {:>9} | met?\n", "SUNDIALS' time / rival's", "ms/s",
             "anchors'", "ours", "behind");
  const double sundials = figure(r, "sundials", "s/s") * 1e3;
  for (const Anchor& anchor : anchors) {
    const double ours = figure(r, anchor.name, "s/s") * 1e3;
    const double asked = yardstick / anchor.milliseconds, measured = sundials / ours;
    fmt::print("  {:<24} | {:>10.3g} | {:>12.3g} | {:>9.3g} | {:>8.2f}x | {}\n", anchor.name, ours, asked,
               measured, asked / measured, yes_no(asked / measured <= most_behind));
  }
  for (const char* name : without_anchor) {
    const double ours = figure(r, name, "s/s") * 1e3;
    fmt::print("  {:<24} | {:>10.3g} | {:>12} | {:>9.3g} |\n", name, ours, "", sundials / ours);
  }
  fmt::print("  {:<24} | {:>10.3g} |\n", "sundials (yardstick)", sundials);
}

void print_units(const Results& r) {
  fmt::print("\n  {:<36} | {:>9} | {:>9} | met?\n", "unit cost", "asked, us", "ours, us");
  for (const Unit& unit : units) {
    const double ours = figure(r, unit.name, unit.counter);
    fmt::print("  {:<36} | {:>9.3g} | {:>9.3g} | {}\n", unit.what, unit.most * 1e6, ours * 1e6,
               yes_no(ours <= unit.most));
  }
  const double pass = figure(r, "force_pass", "s/pass"), step = figure(r, "velocity_verlet", "s/step");
  fmt::print("  {:<36} | {:>9.3g} | {:>9.3g} | {}\n", "velocity Verlet, in force passes", 2.0, step / pass,
             yes_no(step <= 2 * pass));
  fmt::print("  {:<36} | {:>9} | {:>9.3g} |\n", "a force pass of 1,482 springs", "", pass * 1e6);
}

void print_all(const Results& r, const std::string&) {
  print_ratios(r);
  print_units(r);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  return hopmesh::bench::print_tables(argc, argv, 1, "rivals_table RIVALS.json", hopmesh::bench::print_all);
}
