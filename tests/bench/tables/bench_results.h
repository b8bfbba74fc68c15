// What Google Benchmark wrote: rows of one name, and their medians.
#pragma once

#include <string>
#include <vector>

namespace hopmesh::bench {

/// A benchmark's repetitions of one quantity.
struct Samples {
  std::vector<double> values;
  double median() const;
  double least() const;
  double largest() const;
};

class Results {
 public:
  /// Adds a file of --benchmark_out. Throws std::runtime_error when it cannot be read.
  void read(const std::string& file);

  /// Names of the form prefix + "/...", without the prefix, in order of first appearance.
  std::vector<std::string> names(const std::string& prefix) const;
  /// "real_time" and counters. Throws std::runtime_error where there is no such benchmark or counter.
  Samples samples(const std::string& name, const std::string& counter) const;
  double median(const std::string& name, const std::string& counter) const {
    return samples(name, counter).median();
  }
  /// Complaints of benchmarks that refused to give a time.
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  struct Row {
    std::string name, counter;
    double value;
  };
  std::vector<Row> rows_;
  std::vector<std::string> errors_;
};

/// The main of a program that prints tables: reads `files` files and calls print with them and the name of
/// the picture that may follow, empty where none does.
int print_tables(int argc, char** argv, int files, const char* usage,
                 void (*print)(const Results& results, const std::string& picture_file));

} // namespace hopmesh::bench
