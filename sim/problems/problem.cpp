#include "sim/problems/problem.h"

#include "sim/problems/making.h"

#include <map>
#include <stdexcept>

namespace hopmesh::problems {
namespace {

using Maker = std::function<Problem(std::uint64_t seed)>;

struct Entry {
  std::string name;
  Maker make;
};

const std::map<std::string, MemoryPlan>& memories() {
  static const std::map<std::string, MemoryPlan> plans{{"memory-100", {10, 10, 5, 0.1, false}},
                                                       {"memory-400", {20, 20, 40, 0.1, false}},
                                                       {"memory-1000", {25, 40, 100, 0.1, false}},
                                                       {"memory-1000-projection", {25, 40, 100, 0.1, true}}};
  return plans;
}

Entry memory_entry(const char* name) {
  return {name, [name](std::uint64_t seed) { return memory(memories().at(name), seed); }};
}

const std::vector<Entry>& entries() {
  using Seed = std::uint64_t;
  static const std::vector<Entry> all{
      {"two-neurons", [](Seed) { return two_neurons(); }},
      memory_entry("memory-100"),
      memory_entry("memory-400"),
      memory_entry("memory-1000"),
      memory_entry("memory-1000-projection"),
      {"cut-16", [](Seed seed) { return random_cut(16, 0.5, seed); }},
      {"cut-20", [](Seed seed) { return random_cut(20, 0.5, seed); }},
      {"cut-24", [](Seed seed) { return random_cut(24, 0.5, seed); }},
      {"cut-ring-1001", [](Seed seed) { return ring_cut(1001, seed); }},
      {"cut-hidden-1000", [](Seed seed) { return bipartite_cut(1000, 5000, seed); }},
      {"cut-torus-10000", [](Seed seed) { return torus_cut(100, seed); }},
      {"cut-torus-99856", [](Seed seed) { return torus_cut(316, seed); }},
      {"queens-8", [](Seed seed) { return queens(8, seed); }},
      {"queens-16", [](Seed seed) { return queens(16, seed); }},
      {"queens-32", [](Seed seed) { return queens(32, seed); }},
      {"box-corner-20", [](Seed) { return corner_quadratic(20); }},
      {"box-membrane-100", [](Seed) { return grid_quadratic(10, 0, 1, 5); }},
      {"box-membrane-1024", [](Seed) { return grid_quadratic(32, 0, 0.2, 16); }},
      {"box-screened-10000", [](Seed) { return grid_quadratic(100, 0.1, 0.6, 8); }},
      {"box-screened-99856", [](Seed) { return grid_quadratic(316, 0.1, 0.6, 8); }},
      {"box-random-100", [](Seed) { return random_quadratic(100, 8, 0.05); }},
      {"box-random-1000", [](Seed) { return random_quadratic(1000, 8, 0.05); }},
      {"box-random-10000", [](Seed) { return random_quadratic(10'000, 8, 0.05); }},
      {"box-random-100000", [](Seed) { return random_quadratic(100'000, 8, 0.05); }},
  };
  return all;
}

} // namespace

const std::vector<std::string>& names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> made;
    for (const Entry& entry : entries()) made.push_back(entry.name);
    return made;
  }();
  return all;
}

Problem make(const std::string& name, std::uint64_t seed) {
  for (const Entry& entry : entries()) {
    if (entry.name != name) continue;
    Problem problem = entry.make(seed);
    problem.name = name;
    return problem;
  }
  throw std::out_of_range("no problem is called " + name);
}

std::vector<double> pattern_of(const std::string& name, std::uint64_t seed) {
  const auto plan = memories().find(name);
  return plan == memories().end() ? std::vector<double>() : memory_pattern(plan->second, seed);
}

} // namespace hopmesh::problems
