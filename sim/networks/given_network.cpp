#include "sim/networks/given_network.h"

#include "sim/input/input_error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace hopmesh::networks {

namespace {

using files::MatrixEntry;
using files::SparseMatrix;

constexpr std::size_t most_neurons = 4'000'000, most_weights = 60'000'000;
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

reference::Vector vector_of(const std::vector<double>& values) {
  return Eigen::Map<const reference::Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
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

GivenNetwork::GivenNetwork(const NetworkData& data, double start_of_none) {
  const auto n = static_cast<Eigen::Index>(data.W.rows);
  find_links(data.W);
  fill_rows(data.W);
  const std::vector<double> bias = data.bias.empty() ? std::vector<double>(data.W.rows, 0.0) : data.bias;
  network_ = network_of(rows_, bias);
  network_.W.prune(0.0, 0.0);
  start_ = data.start.empty() ? reference::Vector::Constant(n, start_of_none).eval() : vector_of(data.start);
  describe();
}

// The two directions of every coupling, row by row, each once.
void GivenNetwork::find_links(const SparseMatrix& W) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
  links.reserve(2 * W.entries.size());
  for (const MatrixEntry& e : W.entries) {
    const auto row = static_cast<std::uint32_t>(e.row), column = static_cast<std::uint32_t>(e.column);
    if (e.value == 0 || row == column) continue;
    links.emplace_back(row, column);
    links.emplace_back(column, row);
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  topology_.neurons_per_cell = 1;
  topology_.first_link.assign(W.rows + 1, 0);
  topology_.link_to.reserve(links.size());
  for (const auto& [from, to] : links) {
    topology_.first_link[from + 1] += 1;
    topology_.link_to.push_back(to);
  }
  std::partial_sum(topology_.first_link.begin(), topology_.first_link.end(), topology_.first_link.begin());
}

// A row is the neuron itself, then its links in ascending order.
void GivenNetwork::fill_rows(const SparseMatrix& W) {
  rows_.assign(topology_.weight_words(), 0.0);
  for (const MatrixEntry& e : W.entries) {
    if (e.value == 0) continue;
    const auto first = topology_.link_to.begin() + topology_.first_link[e.row];
    const auto last = topology_.link_to.begin() + topology_.first_link[e.row + 1];
    const std::size_t tap = e.row == e.column ? 0 : 1 + (std::lower_bound(first, last, e.column) - first);
    rows_[topology_.row_offset(e.row, 0) + tap] = e.value;
  }
}

reference::Network GivenNetwork::network_of(const std::vector<double>& rows,
                                            const std::vector<double>& bias) const {
  const auto n = static_cast<Eigen::Index>(neurons());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(rows.size());
  for (std::size_t c = 0; c < neurons(); ++c) {
    const std::size_t row = topology_.row_offset(c, 0);
    entries.emplace_back(c, c, rows[row]);
    for (std::size_t k = 0; k < topology_.degree(c); ++k)
      entries.emplace_back(c, topology_.link_to[topology_.first_link[c] + k], rows[row + 1 + k]);
  }
  reference::Matrix W(n, n);
  W.setFromTriplets(entries.begin(), entries.end());
  return {W, vector_of(bias)};
}

void GivenNetwork::describe() {
  numbers_.resize(neurons());
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  firmware_.nodes = firmware_.cells = static_cast<std::uint32_t>(neurons());
  firmware_.components = 1;
  firmware_.cell_of_node = firmware_.node_of_cell = numbers_.data();
  firmware_.first_link = topology_.first_link.data();
  firmware_.link_to = topology_.link_to.data();
}

} // namespace hopmesh::networks
