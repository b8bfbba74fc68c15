#include "sim/networks/problems/problem.h"

#include "sim/input/input_error.h"
#include "sim/networks/problems/making.h"

#include <map>
#include <stdexcept>

namespace hopmesh::problems {
namespace {

using Maker = std::function<Problem(std::uint64_t seed)>;

struct Entry {
  std::string name, about;
  Maker make;
};

const std::map<std::string, MemoryPlan>& memories() {
  static const std::map<std::string, MemoryPlan> plans{{"memory-100", {10, 10, 5, 0.1, false}},
                                                       {"memory-400", {20, 20, 40, 0.1, false}},
                                                       {"memory-1000", {25, 40, 100, 0.1, false}},
                                                       {"memory-1000-projection", {25, 40, 100, 0.1, true}}};
  return plans;
}

Entry memory_entry(const char* name, const char* about) {
  return {name, about, [name](std::uint64_t seed) { return memory(memories().at(name), seed); }};
}

const std::vector<Entry>& entries() {
  using Seed = std::uint64_t;
  static const std::vector<Entry> all{
      {"two-neurons", "two neurons that turn each other; both at once they flip for ever",
       [](Seed) { return two_neurons(); }},
      memory_entry("memory-100", "5 patterns by Hebb's rule, one with a tenth of its signs turned"),
      memory_entry("memory-400", "40 patterns by Hebb's rule, one with a tenth of its signs turned"),
      memory_entry("memory-1000", "100 patterns by Hebb's rule, one with a tenth of its signs turned"),
      memory_entry("memory-1000-projection", "the same patterns by the pseudo-inverse"),
      {"cut-16", "max-cut of a random graph with half of all edges",
       [](Seed seed) { return random_cut(16, 0.5, seed); }},
      {"cut-20", "max-cut of a random graph with half of all edges",
       [](Seed seed) { return random_cut(20, 0.5, seed); }},
      {"cut-24", "max-cut of a random graph with half of all edges",
       [](Seed seed) { return random_cut(24, 0.5, seed); }},
      {"cut-ring-1001", "max-cut of an odd ring: an edge is left",
       [](Seed seed) { return ring_cut(1001, seed); }},
      {"cut-hidden-1000", "max-cut of 5,000 random edges between two hidden sides",
       [](Seed seed) { return bipartite_cut(1000, 5000, seed); }},
      {"cut-torus-10000", "max-cut of a torus of 100 x 100: a chessboard cuts all",
       [](Seed seed) { return torus_cut(100, seed); }},
      {"cut-torus-99856", "max-cut of a torus of 316 x 316: a chessboard cuts all",
       [](Seed seed) { return torus_cut(316, seed); }},
      {"queens-8", "8 queens on a board of 8 x 8", [](Seed seed) { return queens(8, seed); }},
      {"queens-16", "16 queens on a board of 16 x 16", [](Seed seed) { return queens(16, seed); }},
      {"queens-32", "32 queens on a board of 32 x 32", [](Seed seed) { return queens(32, seed); }},
      {"box-corner-20", "random, diagonal above 0: the least is at a corner",
       [](Seed) { return corner_quadratic(20); }},
      {"box-membrane-100", "grid Laplacian 10 x 10, patches pushed up and down",
       [](Seed) { return grid_quadratic(10, 0, 1, 5); }},
      {"box-membrane-1024", "grid Laplacian 32 x 32, patches pushed up and down",
       [](Seed) { return grid_quadratic(32, 0, 0.2, 16); }},
      {"box-screened-10000", "grid Laplacian 100 x 100 + 0.1, patches pushed up and down",
       [](Seed) { return grid_quadratic(100, 0.1, 0.6, 8); }},
      {"box-screened-99856", "grid Laplacian 316 x 316 + 0.1, patches pushed up and down",
       [](Seed) { return grid_quadratic(316, 0.1, 0.6, 8); }},
      {"box-random-100", "about 8 random couplings a neuron, diagonal 1.05 times their sum",
       [](Seed) { return random_quadratic(100, 8, 0.05); }},
      {"box-random-1000", "about 8 random couplings a neuron, diagonal 1.05 times their sum",
       [](Seed) { return random_quadratic(1000, 8, 0.05); }},
      {"box-random-10000", "about 8 random couplings a neuron, diagonal 1.05 times their sum",
       [](Seed) { return random_quadratic(10'000, 8, 0.05); }},
      {"box-random-100000", "about 8 random couplings a neuron, diagonal 1.05 times their sum",
       [](Seed) { return random_quadratic(100'000, 8, 0.05); }},
  };
  return all;
}

const Entry& entry_of(const std::string& name) {
  for (const Entry& entry : entries())
    if (entry.name == name) return entry;
  throw std::out_of_range("no problem is called " + name);
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

void check_name(const std::string& name, const std::string& where) {
  if (std::find(names().begin(), names().end(), name) == names().end())
    throw input::input_error("", 0, where, input::in_quotes(name),
                             "a file, or a problem that `hopmesh problems` lists",
                             input::nearest_name(name, names()));
}

const std::string& about(const std::string& name) {
  return entry_of(name).about;
}

Problem make(const std::string& name, std::uint64_t seed) {
  Problem problem = entry_of(name).make(seed);
  problem.name = name;
  return problem;
}

std::vector<double> pattern_of(const std::string& name, std::uint64_t seed) {
  const auto plan = memories().find(name);
  return plan == memories().end() ? std::vector<double>() : memory_pattern(plan->second, seed);
}

} // namespace hopmesh::problems
