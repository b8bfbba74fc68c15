#include "sim/files/csv_table.h"

#include "sim/files/csv.h"
#include "sim/input/input_error.h"
#include "sim/input/number.h"
#include "sim/input/whole_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace hopmesh::files {

namespace {

/// A cell, from `at` on; leaves `at` behind its comma or on its line's end.
std::string take_cell(std::string_view text, std::size_t& at) {
  std::string cell;
  bool quoted = at < text.size() && text[at] == '"';
  if (quoted) ++at;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted && c == '"') {
      if (at + 1 < text.size() && text[at + 1] == '"')
        ++at;
      else {
        quoted = false;
        continue;
      }
    } else if (!quoted && (c == ',' || c == '\n')) {
      break;
    }
    cell += c;
  }
  return cell;
}

std::vector<std::string> take_row(std::string_view text, std::size_t& at) {
  std::vector<std::string> row{take_cell(text, at)};
  while (at < text.size() && text[at] == ',') row.push_back(take_cell(text, ++at));
  ++at;
  return row;
}

} // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const {
  for (std::size_t k = 0; k < header.size(); ++k)
    if (header[k] == name) return k;
  return std::nullopt;
}

const std::string& CsvTable::text(std::size_t row, std::string_view name) const {
  static const std::string none;
  const auto k = column(name);
  return k ? rows[row][*k] : none;
}

std::optional<double> CsvTable::number(std::size_t row, std::string_view name) const {
  double value = 0;
  if (!input::parse_number(text(row, name), value) || !std::isfinite(value)) return std::nullopt;
  return value;
}

namespace {

/// A text's rows one after the other, each with its place.
class Rows {
 public:
  Rows(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  bool more() const { return at_ < text_.size(); }
  std::vector<std::string> next() {
    line_ += static_cast<int>(std::count(raw_.begin(), raw_.end(), '\n')) + (at_ > 0 ? 1 : 0);
    const std::size_t begin = at_;
    std::vector<std::string> row = take_row(text_, at_);
    raw_ = text_.substr(begin, at_ - 1 - begin);
    return row;
  }
  /// The text of the row that was taken last.
  std::string_view raw() const { return raw_; }
  input::InputError error(const std::string& key, const std::string& found,
                          const std::string& expected) const {
    return input::input_error(path_, line_, key, found, expected);
  }

 private:
  std::string_view text_, raw_;
  const std::string& path_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::vector<std::string> next_of(Rows& rows, std::size_t cells) {
  std::vector<std::string> row = rows.next();
  if (row.size() != cells)
    throw rows.error("", fmt::format("{} cells", row.size()), fmt::format("{}, as in the header", cells));
  return row;
}

void expect_check(const Rows& rows) {
  const std::size_t comma = rows.raw().rfind(',');
  const std::string_view found = rows.raw().substr(comma + 1);
  const std::string wanted = check_of_row(rows.raw().substr(0, comma));
  if (found != wanted) throw rows.error("check", "a damaged row, " + input::in_quotes(found), wanted);
}

} // namespace

CsvTable parse_csv(std::string_view text, const std::string& path) {
  CsvTable table;
  Rows rows(text, path);
  table.header = rows.next();
  while (rows.more()) table.rows.push_back(next_of(rows, table.header.size()));
  return table;
}

CsvTable parse_checked_csv(std::string_view text, const std::string& path,
                           const std::vector<std::string>& columns) {
  CsvTable table{columns, {}};
  std::vector<std::string> header = columns;
  header.emplace_back("check");
  Rows rows(text, path);
  if (rows.next() != header)
    throw rows.error("", "other columns", input::in_quotes(fmt::format("{}", fmt::join(header, ","))));
  while (rows.more()) {
    table.rows.push_back(next_of(rows, header.size()));
    expect_check(rows);
    table.rows.back().pop_back();
  }
  return table;
}

CsvTable read_csv(const std::filesystem::path& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  return parse_csv(input::read_whole_file(path.string(), "a table", most_bytes), path.string());
}

} // namespace hopmesh::files
