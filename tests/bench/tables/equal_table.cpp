// Time of a step at equal answers, from the file of bench_equal (docs/findings/array-against-integrators.md).
#include "tests/bench/tables/bench_results.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace hopmesh::bench {
namespace {

constexpr double micro = 1e6; // us a second

/// "banner/array" is the row of a scene, and of whoever makes its steps.
std::pair<std::string, std::string> parted(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return {name.substr(0, slash), name.substr(slash + 1)};
}

double figure(const Results& r, const std::string& scene, const std::string& who, const char* counter) {
  return r.samples("equal/" + scene + '/' + who, counter).least();
}

void print_array(const Results& r, const std::string& scene) {
  const auto of = [&](const char* counter) { return figure(r, scene, "array", counter); };
  const double hardware = of("hardware s/step");
  fmt::print("| {} | array | {:.2g} | {:.1f} sweeps | {:.0f}, {:.0f} % bus | | 1 |\n", scene, of("error"),
             of("iterations/step"), hardware * micro, 100 * of("bus s/step") / hardware);
  fmt::print("| | array, 27 lanes, bus of 128 bits | | | {:.0f} | | {:.2g} |\n", of("wide s/step") * micro,
             of("wide s/step") / hardware);
  fmt::print("| | array, emulated | | | {:.0f} | | {:.2g} |\n", of("s/step") * micro,
             of("s/step") / hardware);
}

/// A rival's row; returns the array's time on hardware over the rival's.
double print_rival(const Results& r, const std::string& scene, const std::string& who) {
  const auto of = [&](const char* counter) { return figure(r, scene, who, counter); };
  const double seconds = of("s/step"), hardware = figure(r, scene, "array", "hardware s/step");
  fmt::print("| | `{}` | {:.2g} | {:.1f} | {:.0f} | {:.2g} | {:.2g} |\n", who, of("error"),
             of("iterations/step"), seconds * micro, of("tolerance"), seconds / hardware);
  return hardware / seconds;
}

void print_ranges(const std::map<std::string, std::vector<double>>& ratios) {
  fmt::print(
      "\n| the array's time on hardware / a rival's | least | largest | scenes |\n|---|---:|---:|---:|\n");
  for (const auto& [who, all] : ratios)
    fmt::print("| `{}` | {:.2g} | {:.2g} | {} |\n", who, *std::min_element(all.begin(), all.end()),
               *std::max_element(all.begin(), all.end()), all.size());
}

void print_all(const Results& r, const std::string&) {
  fmt::print(
      "\n| scene | who | error of a step, m | iterations a step | µs a step | tolerance, m | times the "
      "array's |\n|---|---|---:|---:|---:|---:|---:|\n");
  std::map<std::string, std::vector<double>> ratios;
  for (const std::string& name : r.names("equal")) {
    const auto [scene, who] = parted(name);
    if (who == "array")
      print_array(r, scene);
    else
      ratios[who].push_back(print_rival(r, scene, who));
  }
  print_ranges(ratios);
}

} // namespace
} // namespace hopmesh::bench

int main(int argc, char** argv) {
  return hopmesh::bench::print_tables(argc, argv, 1, "equal_table EQUAL.json", hopmesh::bench::print_all);
}
