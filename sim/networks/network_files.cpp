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
/// Of the largest weight: what sums in double may differ by, a five-hundredth of the last place of 32 bits.
constexpr double round_off = 0x1p-40;

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

/// Where W and its transpose differ most.
struct Asymmetry {
  double difference = 0, largest = 0; ///< largest: of all magnitudes
  MatrixEntry worst{0, 0, 0};
};

Asymmetry asymmetry_of(const SparseMatrix& W) {
  Asymmetry a;
  for (const MatrixEntry& e : W.entries) {
    a.largest = std::max(a.largest, std::abs(e.value));
    const double difference = std::abs(e.value - value_at(W, e.column, e.row));
    if (difference > a.difference) a.difference = difference, a.worst = e;
  }
  return a;
}

/// The mean of W and its transpose.
SparseMatrix symmetrised(const SparseMatrix& W) {
  SparseMatrix mean{W.rows, W.columns, {}};
  mean.entries.reserve(W.entries.size());
  for (const MatrixEntry& e : W.entries) {
    const double half = e.value / 2, other = value_at(W, e.column, e.row) / 2;
    const MatrixEntry mirror{e.column, e.row, half + other};
    mean.entries.push_back({e.row, e.column, half + other});
    if (!std::binary_search(W.entries.begin(), W.entries.end(), mirror, before))
      mean.entries.push_back(mirror);
  }
  std::sort(mean.entries.begin(), mean.entries.end(), before);
  return mean;
}

void make_symmetric(NetworkData& data, const std::string& file) {
  const Asymmetry a = asymmetry_of(data.W);
  if (a.difference == 0) return;
  if (a.difference > round_off * a.largest)
    throw input::input_error(
        file, 0, "",
        fmt::format("W({0},{1}) = {2} but W({1},{0}) = {3}, which differ most, by {4:.6g}", a.worst.row + 1,
                    a.worst.column + 1, a.worst.value, value_at(data.W, a.worst.column, a.worst.row),
                    a.difference),
        "a symmetric matrix, or --asymmetric");
  data.W = symmetrised(data.W);
  data.notes.push_back(
      fmt::format("{}: W and its transpose differ by {:.2g} at most, which is round-off: their mean "
                  "is taken",
                  file, a.difference));
}

std::vector<double> read_values(const std::string& file, std::size_t rows) {
  if (file.empty()) return {};
  return files::read_vector(file, files::RowsWanted{rows, "as W has"});
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
  if (!files.asymmetric) make_symmetric(data, files.weights);
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
