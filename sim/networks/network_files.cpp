#include "sim/networks/network_files.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/input/input_error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::networks {

namespace {

using files::MatrixEntry;
using files::SparseMatrix;

constexpr std::size_t most_neurons = spec::most_cells, most_weights = 60'000'000;

bool before(const MatrixEntry& a, const MatrixEntry& b) {
  return a.row != b.row ? a.row < b.row : a.column < b.column;
}

double value_at(const SparseMatrix& W, std::size_t row, std::size_t column) {
  const MatrixEntry wanted{row, column, 0};
  const auto at = std::lower_bound(W.entries.begin(), W.entries.end(), wanted, before);
  return at != W.entries.end() && at->row == row && at->column == column ? at->value : 0;
}

void check_shape(const SparseMatrix& W, const std::string& file) {
  if (W.rows != W.columns)
    throw input::input_error(file, 0, "", fmt::format("{} x {}", W.rows, W.columns),
                             "as many rows as columns");
  if (W.rows > most_neurons || W.entries.size() > most_weights)
    throw input::input_error(file, 0, "", fmt::format("{} rows, {} entries", W.rows, W.entries.size()),
                             fmt::format("at most {} and {}", most_neurons, most_weights));
}

void check_symmetry(const SparseMatrix& W, const std::string& file) {
  double largest = 0;
  MatrixEntry worst{0, 0, 0};
  for (const MatrixEntry& e : W.entries) {
    const double difference = std::abs(e.value - value_at(W, e.column, e.row));
    if (difference > largest) largest = difference, worst = e;
  }
  if (largest == 0) return;
  throw input::input_error(file, 0, "",
                           fmt::format("W({0},{1}) = {2} but W({1},{0}) = {3}, which differ most, by {4:.6g}",
                                       worst.row + 1, worst.column + 1, worst.value,
                                       value_at(W, worst.column, worst.row), largest),
                           "a symmetric matrix, or --asymmetric");
}

std::vector<double> read_values(const std::string& file, std::size_t rows) {
  if (file.empty()) return {};
  std::vector<double> values = files::read_vector(file);
  if (values.size() != rows)
    throw input::input_error(file, 0, "", fmt::format("{} rows", values.size()),
                             fmt::format("{}, as W has", rows));
  return values;
}

void check_start(const std::vector<double>& start, const std::string& file) {
  const auto outside = std::find_if(start.begin(), start.end(), [](double v) { return std::abs(v) > 1; });
  if (outside == start.end()) return;
  throw input::input_error(file, 0, "", fmt::format("{} in row {}", *outside, outside - start.begin() + 1),
                           "outputs from -1 to 1");
}

} // namespace

NetworkData read_network(const NetworkFiles& files) {
  NetworkData data{files::read_matrix(files.weights), {}, {}};
  check_shape(data.W, files.weights);
  if (!files.asymmetric) check_symmetry(data.W, files.weights);
  data.bias = read_values(files.bias, data.W.rows);
  data.start = read_start(files.start, data.W.rows);
  return data;
}

std::vector<double> read_start(const std::string& file, std::size_t neurons) {
  std::vector<double> start = read_values(file, neurons);
  check_start(start, file);
  return start;
}

} // namespace hopmesh::networks
