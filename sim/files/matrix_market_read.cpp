// Reads Matrix Market files in one walk over their lines: banner, comments, sizes, entries. Whatever is not
// as the format says is refused with its line.
#include "sim/files/matrix_market.h"
#include "sim/input/input_error.h"
#include "sim/input/whole_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace hopmesh::files {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 32;
constexpr std::size_t most_rows = std::size_t{1} << 31;

std::string_view next_word(std::string_view& rest) {
  const auto first = rest.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return rest = {};
  rest.remove_prefix(first);
  const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r"));
  rest.remove_prefix(word.size());
  return word;
}

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

class MarketReader {
 public:
  explicit MarketReader(const std::string& path)
      : path_(path), text_(input::read_whole_file(path, "a Matrix Market file", most_bytes)), rest_(text_) {}

  SparseMatrix read() {
    read_banner();
    read_sizes();
    if (dense_)
      read_columns();
    else
      read_entries();
    std::string_view line;
    if (next_line(line)) fail(input::in_quotes(line), fmt::format("the end, after {} entries", count_));
    sort_entries();
    return std::move(matrix_);
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw input::input_error(path_, line_, "", found, expected);
  }

  /// The next line that is neither blank nor a comment; false at the end of the file.
  bool next_line(std::string_view& line) {
    while (!rest_.empty()) {
      ++line_;
      line = rest_.substr(0, rest_.find('\n'));
      rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
      const auto first = line.find_first_not_of(" \t\r");
      if (first != std::string_view::npos && line[first] != '%') return true;
    }
    return false;
  }

  std::string choice(std::string_view& line, const std::vector<std::string>& names) const {
    const std::string_view word = next_word(line);
    std::string name = lower(word);
    if (std::find(names.begin(), names.end(), name) != names.end()) return name;
    throw input::input_error(path_, line_, "", word.empty() ? "the banner's end" : input::in_quotes(word),
                             fmt::format("{}", fmt::join(names, ", ")), input::nearest_name(name, names));
  }

  void read_banner() {
    line_ = 1;
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(rest_.size(), line.size() + 1));
    const std::string_view all = line;
    if (lower(next_word(line)) != "%%matrixmarket")
      fail(input::in_quotes(all), "%%MatrixMarket matrix coordinate real general, or the like");
    choice(line, {"matrix"});
    dense_ = choice(line, {"coordinate", "array"}) == "array";
    const std::string field =
        dense_ ? choice(line, {"real", "integer"}) : choice(line, {"real", "integer", "pattern"});
    pattern_ = field == "pattern";
    symmetric_ = choice(line, {"general", "symmetric"}) == "symmetric";
    expect_end(line);
  }

  void expect_end(std::string_view line) const {
    const std::string_view word = next_word(line);
    if (!word.empty()) fail(input::in_quotes(word), "the end of the line");
  }

  std::size_t whole(std::string_view& line, std::size_t least, std::size_t most, const char* name) const {
    const std::string_view word = next_word(line);
    std::size_t n = 0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), n);
    if (failure != std::errc() || end != word.data() + word.size() || n < least || n > most)
      fail(word.empty() ? "the end of the line" : input::in_quotes(word),
           fmt::format("{}, an integer from {} to {}", name, least, most));
    return n;
  }

  double real(std::string_view& line) const {
    const std::string_view word = next_word(line);
    std::string_view digits = word;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double x = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), x);
    if (failure != std::errc() || end != digits.data() + digits.size() || !std::isfinite(x))
      fail(word.empty() ? "the end of the line" : input::in_quotes(word), "a finite number");
    return x;
  }

  void read_sizes() {
    std::string_view line;
    if (!next_line(line)) fail("the end of the file", "a line with the sizes");
    matrix_.rows = whole(line, 1, most_rows, "the number of rows");
    matrix_.columns = whole(line, 1, most_rows, "the number of columns");
    const std::size_t places = matrix_.rows * matrix_.columns;
    count_ = dense_ ? places : whole(line, 0, places, "the number of entries");
    expect_end(line);
    if (symmetric_ && matrix_.rows != matrix_.columns)
      fail(fmt::format("{} x {}, symmetric", matrix_.rows, matrix_.columns),
           "as many rows as columns, or general");
    if (dense_ && symmetric_) count_ = matrix_.rows * (matrix_.rows + 1) / 2;
    matrix_.entries.reserve(std::min(count_, text_.size() / 2) * (symmetric_ ? 2 : 1));
  }

  std::string_view entry_line(std::size_t done) {
    std::string_view line;
    if (next_line(line)) return line;
    fail(fmt::format("the end of the file after {} entries", done), fmt::format("{} entries", count_));
  }

  void add(std::size_t row, std::size_t column, double value) {
    matrix_.entries.push_back({row, column, value});
    if (symmetric_ && row != column) matrix_.entries.push_back({column, row, value});
  }

  void read_entries() {
    for (std::size_t k = 0; k < count_; ++k) {
      std::string_view line = entry_line(k);
      const std::size_t row = whole(line, 1, matrix_.rows, "a row");
      const std::size_t column = whole(line, 1, matrix_.columns, "a column");
      if (symmetric_ && column > row)
        fail(fmt::format("row {}, column {}", row, column),
             "the lower half alone, as a symmetric file has it");
      add(row - 1, column - 1, pattern_ ? 1 : real(line));
      expect_end(line);
    }
  }

  /// Column by column; of a symmetric one from the diagonal down.
  void read_columns() {
    std::size_t done = 0;
    for (std::size_t column = 0; column < matrix_.columns; ++column)
      for (std::size_t row = symmetric_ ? column : 0; row < matrix_.rows; ++row, ++done) {
        std::string_view line = entry_line(done);
        const double value = real(line);
        expect_end(line);
        if (value != 0) add(row, column, value);
      }
  }

  void sort_entries() {
    auto& all = matrix_.entries;
    const auto before = [](const MatrixEntry& a, const MatrixEntry& b) {
      return a.row != b.row ? a.row < b.row : a.column < b.column;
    };
    if (!std::is_sorted(all.begin(), all.end(), before)) std::sort(all.begin(), all.end(), before);
    const auto twice =
        std::adjacent_find(all.begin(), all.end(), [](const MatrixEntry& a, const MatrixEntry& b) {
          return a.row == b.row && a.column == b.column;
        });
    if (twice == all.end()) return;
    throw input::input_error(path_, 0, "",
                             fmt::format("row {}, column {} twice", twice->row + 1, twice->column + 1),
                             "each place once");
  }

  const std::string path_, text_;
  std::string_view rest_;
  int line_ = 0;
  bool dense_ = false, pattern_ = false, symmetric_ = false;
  std::size_t count_ = 0;
  SparseMatrix matrix_;
};

} // namespace

SparseMatrix read_matrix(const std::string& path) {
  return MarketReader(path).read();
}

std::vector<double> read_vector(const std::string& path) {
  const SparseMatrix matrix = read_matrix(path);
  if (matrix.columns != 1)
    throw input::input_error(path, 0, "", fmt::format("{} x {}", matrix.rows, matrix.columns),
                             "a vector: one column");
  std::vector<double> values(matrix.rows, 0.0);
  for (const MatrixEntry& e : matrix.entries) values[e.row] = e.value;
  return values;
}

} // namespace hopmesh::files
