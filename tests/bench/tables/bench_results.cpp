#include "tests/bench/tables/bench_results.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hopmesh::bench {

double Samples::median() const {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return n % 2 ? sorted[n / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
}

double Samples::least() const {
  return *std::min_element(values.begin(), values.end());
}

double Samples::largest() const {
  return *std::max_element(values.begin(), values.end());
}

// Google Benchmark appends its settings to a name: "/iterations:1/repeats:9", "/min_time:0.1/real_time".
std::string without_settings(const std::string& name) {
  std::size_t end = name.size();
  for (const char* setting : {"/iterations:", "/min_time:", "/repeats:", "/real_time", "/manual_time"})
    end = std::min(end, name.find(setting));
  return name.substr(0, end);
}

void Results::read(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file);
  const auto json = nlohmann::json::parse(stream);
  for (const auto& entry : json.at("benchmarks")) {
    if (entry.at("run_type") != "iteration") continue;
    const std::string name = without_settings(entry.at("name"));
    if (entry.value("error_occurred", false))
      errors_.push_back(name + ": " + entry.value("error_message", "failed"));
    for (const auto& [counter, value] : entry.items())
      if (value.is_number()) rows_.push_back({name, counter, value.get<double>()});
  }
}

std::vector<std::string> Results::names(const std::string& prefix) const {
  std::vector<std::string> found;
  for (const Row& row : rows_) {
    if (row.name.compare(0, prefix.size() + 1, prefix + "/") != 0) continue;
    const std::string rest = row.name.substr(prefix.size() + 1);
    if (std::find(found.begin(), found.end(), rest) == found.end()) found.push_back(rest);
  }
  return found;
}

Samples Results::samples(const std::string& name, const std::string& counter) const {
  Samples samples;
  for (const Row& row : rows_)
    if (row.name == name && row.counter == counter) samples.values.push_back(row.value);
  if (samples.values.empty()) throw std::runtime_error("no " + counter + " of benchmark " + name);
  return samples;
}

int print_tables(int argc, char** argv, int files, const char* usage,
                 void (*print)(const Results& results, const std::string& picture_file)) try {
  if (argc <= files) return fmt::print(stderr, "usage: {}\n", usage), 2;
  Results results;
  for (int k = 1; k <= files; ++k) results.read(argv[k]);
  if (results.errors().empty()) print(results, argc > files + 1 ? argv[files + 1] : "");
  for (const std::string& error : results.errors()) fmt::print(stderr, "bench: {}\n", error);
  return results.errors().empty() ? 0 : 1;
} catch (const std::exception& e) {
  fmt::print(stderr, "bench: {}\n", e.what());
  return 1;
}

} // namespace hopmesh::bench
