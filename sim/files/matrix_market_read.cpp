// Reads Matrix Market files in one walk over their lines: banner, comments, sizes, entries. Whatever is not
// as the format says is refused with its line.
#include "sim/files/matrix_market.h"

#include "sim/input/input_error.h"
#include "sim/input/line_reader.h"
#include "sim/input/number.h"
#include "sim/input/whole_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace hopmesh::files {

namespace {

using input::Words;

constexpr std::size_t most_bytes = std::size_t{1} << 32;
constexpr std::size_t most_rows = std::size_t{1} << 31;

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

class MarketReader {
 public:
  explicit MarketReader(const std::string& path)
      : path_(path), text_(input::read_whole_file(path, "a Matrix Market file", most_bytes)), lines_(text_) {}

  SparseMatrix read() {
    read_banner();
    read_sizes();
    if (dense_)
      read_columns();
    else
      read_entries();
    if (next_line()) fail(input::in_quotes(lines_.line()), fmt::format("the end, after {} entries", count_));
    sort_entries();
    return std::move(matrix_);
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw input::input_error(path_, lines_.number(), "", found, expected);
  }

  /// Goes to the next line that is neither blank nor a comment; false at the end of the file.
  bool next_line() {
    while (lines_.next()) {
      const std::string_view word = Words(lines_.line()).next();
      if (!word.empty() && word[0] != '%') return true;
    }
    return false;
  }

  std::string choice(Words& words, const std::vector<std::string>& names) const {
    const std::string_view word = words.next();
    std::string name = lower(word);
    if (std::find(names.begin(), names.end(), name) != names.end()) return name;
    throw input::input_error(path_, lines_.number(), "",
                             word.empty() ? "the banner's end" : input::in_quotes(word),
                             fmt::format("{}", fmt::join(names, ", ")), input::nearest_name(name, names));
  }

  void read_banner() {
    lines_.next();
    Words words(lines_.line());
    const std::string banner = lower(words.next());
    if (banner != "%%matrixmarket" && banner != "%matrixmarket") // one %: as networkrepository.com writes it
      fail(input::in_quotes(lines_.line()), "%%MatrixMarket matrix coordinate real general, or the like");
    choice(words, {"matrix"});
    dense_ = choice(words, {"coordinate", "array"}) == "array";
    const std::string field =
        dense_ ? choice(words, {"real", "integer"}) : choice(words, {"real", "integer", "pattern"});
    pattern_ = field == "pattern";
    integer_ = field == "integer";
    const std::vector<std::string> signed_kinds{"general", "symmetric", "skew-symmetric"};
    const std::string kind =
        choice(words, pattern_ ? std::vector<std::string>{"general", "symmetric"} : signed_kinds);
    skew_ = kind == "skew-symmetric";
    symmetric_ = skew_ || kind == "symmetric";
    expect_end(words);
  }

  void expect_end(Words& words) const {
    const std::string_view word = words.next();
    if (!word.empty()) fail(input::in_quotes(word), "the end of the line");
  }

  std::size_t whole(Words& words, std::size_t least, std::size_t most, const char* name) const {
    const std::string_view word = words.next();
    std::size_t n = 0;
    if (!input::parse_number(word, n) || n < least || n > most)
      fail(word.empty() ? "the end of the line" : input::in_quotes(word),
           fmt::format("{}, an integer from {} to {}", name, least, most));
    return n;
  }

  double real(Words& words) const {
    const std::string_view word = words.next();
    double x = 0;
    const bool good = input::parse_real(word, x) && std::isfinite(x);
    if (good && (!integer_ || is_integer(word))) return x;
    fail(word.empty() ? "the end of the line" : input::in_quotes(word),
         good ? "an integer, as the banner says" : "a finite number");
  }

  static bool is_integer(std::string_view word) {
    const std::string_view digits = word.substr(word[0] == '+' || word[0] == '-' ? 1 : 0);
    return digits.find_first_not_of("0123456789") == std::string_view::npos;
  }

  void read_sizes() {
    if (!next_line()) fail("the end of the file", "a line with the sizes");
    Words words(lines_.line());
    matrix_.rows = whole(words, 1, most_rows, "the number of rows");
    matrix_.columns = whole(words, 1, most_rows, "the number of columns");
    const std::size_t places = matrix_.rows * matrix_.columns;
    count_ = dense_ ? places : whole(words, 0, places, "the number of entries");
    expect_end(words);
    if (symmetric_ && matrix_.rows != matrix_.columns)
      fail(fmt::format("{} x {}, {}symmetric", matrix_.rows, matrix_.columns, skew_ ? "skew-" : ""),
           "as many rows as columns, or general");
    if (dense_ && symmetric_) count_ = matrix_.rows * (matrix_.rows + 1) / 2 - (skew_ ? matrix_.rows : 0);
    matrix_.entries.reserve(std::min(count_, text_.size() / 2) * (symmetric_ ? 2 : 1));
  }

  Words entry(std::size_t done) {
    if (next_line()) return Words(lines_.line());
    fail(fmt::format("the end of the file after {} entries", done), fmt::format("{} entries", count_));
  }

  void add(std::size_t row, std::size_t column, double value) {
    matrix_.entries.push_back({row, column, value});
    if (symmetric_ && row != column) matrix_.entries.push_back({column, row, skew_ ? -value : value});
  }

  void read_entries() {
    for (std::size_t k = 0; k < count_; ++k) {
      Words words = entry(k);
      const std::size_t row = whole(words, 1, matrix_.rows, "a row");
      const std::size_t column = whole(words, 1, matrix_.columns, "a column");
      if (symmetric_ && (column > row || (skew_ && column == row)))
        fail(fmt::format("row {}, column {}", row, column),
             skew_ ? "the half below the diagonal alone, as a skew-symmetric file has it"
                   : "the lower half alone, as a symmetric file has it");
      add(row - 1, column - 1, pattern_ ? 1 : real(words));
      expect_end(words);
    }
  }

  /// Column by column; of a symmetric one from the diagonal down, of a skew one from below it.
  void read_columns() {
    std::size_t done = 0;
    for (std::size_t column = 0; column < matrix_.columns; ++column)
      for (std::size_t row = symmetric_ ? column + (skew_ ? 1 : 0) : 0; row < matrix_.rows; ++row, ++done) {
        Words words = entry(done);
        const double value = real(words);
        expect_end(words);
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
    if (twice != all.end()) refuse_second(twice->row + 1, twice->column + 1);
  }

  /// Looks through the file once more for the second of two entries at one place.
  [[noreturn]] void refuse_second(std::size_t row, std::size_t column) {
    if (symmetric_ && column > row) std::swap(row, column);
    lines_ = input::LineReader(text_);
    lines_.next();
    next_line(); // the sizes
    for (int first = 0; next_line();) {
      Words words(lines_.line());
      if (whole(words, 1, matrix_.rows, "a row") != row ||
          whole(words, 1, matrix_.columns, "a column") != column)
        continue;
      if (first > 0)
        fail(fmt::format("row {}, column {} twice, first in line {}", row, column, first), "each place once");
      first = lines_.number();
    }
    fail(fmt::format("row {}, column {} twice", row, column), "each place once");
  }

  const std::string path_, text_;
  input::LineReader lines_;
  bool dense_ = false, pattern_ = false, integer_ = false, symmetric_ = false, skew_ = false;
  std::size_t count_ = 0;
  SparseMatrix matrix_;
};

} // namespace

SparseMatrix read_matrix(const std::string& path) {
  return MarketReader(path).read();
}

std::vector<double> read_vector(const std::string& path, std::optional<RowsWanted> wanted) {
  const SparseMatrix matrix = read_matrix(path);
  if (wanted && matrix.rows != wanted->rows) // before room is made: a few bytes may ask for 2^31 rows
    throw input::input_error(path, 0, "", fmt::format("{} rows", matrix.rows),
                             fmt::format("{}, {}", wanted->rows, wanted->why));
  if (matrix.columns != 1)
    throw input::input_error(path, 0, "", fmt::format("{} x {}", matrix.rows, matrix.columns),
                             "a vector: one column");
  std::vector<double> values(matrix.rows, 0.0);
  for (const MatrixEntry& e : matrix.entries) values[e.row] = e.value;
  return values;
}

} // namespace hopmesh::files
