#include "sim/run/step_table.h"

#include "sim/input/input_error.h"
#include "sim/input/number.h"

#include <fmt/format.h>
#include <fstream>
#include <utility>

namespace hopmesh::run {

namespace {

/// A cell from a row. Cells about the reference are empty where it was not asked.
struct Write {
  files::CsvWriter& table;
  const levels::StepRow& row;

  template <class Number> void operator()(Number levels::StepRow::*member) const { table.cell(row.*member); }
  void operator()(levels::HashFigure hash) const { table.cell(fmt::format("{:016x}", row.*hash.member)); }
  void operator()(double levels::ReferenceError::*member) const {
    table.cell(row.error ? std::optional((*row.error).*member) : std::nullopt);
  }
};

/// The cells of one line, taken from left to right.
class Cells {
 public:
  Cells(std::string_view line, std::string file, int number)
      : rest_(line), file_(std::move(file)), number_(number) {}

  bool empty() const { return rest_.empty() || rest_.front() == ','; }

  template <class Number, class... Base>
  void read_cell(Number& value, const char* expected = "a number", Base... base) {
    const std::string_view cell = next();
    expect(input::parse_number(cell, value, base...), cell, expected);
  }
  void read_cell(bool& value) {
    const std::string_view cell = next();
    expect(cell == "0" || cell == "1", cell, "0 or 1");
    value = cell == "1";
  }
  void read_cell(std::optional<double>& value) {
    if (empty()) return pass_empty();
    read_cell(value.emplace());
  }
  void pass_empty() { expect(next().empty(), "a value", "an empty cell"); }
  void expect_end() const { expect(done_, rest_, "the end of the line"); }

 private:
  std::string_view next() {
    expect(!done_, "the end of the line", "one more cell");
    const std::size_t end = rest_.find(',');
    const std::string_view cell = rest_.substr(0, end);
    done_ = end == std::string_view::npos;
    rest_ = done_ ? std::string_view() : rest_.substr(end + 1);
    return cell;
  }
  void expect(bool good, std::string_view found, const char* expected) const {
    if (!good) throw input::input_error(file_, number_, "", input::in_quotes(found), expected);
  }

  std::string_view rest_;
  const std::string file_;
  const int number_;
  bool done_ = false;
};

/// A cell into a row.
struct Read {
  Cells& cells;
  levels::StepRow& row;

  template <class Number> void operator()(Number levels::StepRow::*member) const {
    cells.read_cell(row.*member);
  }
  void operator()(levels::HashFigure hash) const { cells.read_cell(row.*hash.member, "a hash", 16); }
  void operator()(double levels::ReferenceError::*member) const {
    if (row.error)
      cells.read_cell((*row.error).*member);
    else
      cells.pass_empty();
  }
};

levels::StepRow row_of(Cells cells, const StepColumns& columns) {
  levels::StepRow row;
  bool undecided = true; // the first cell about the reference tells whether it was asked
  for (const levels::StepColumn& column : columns) {
    const bool of_reference = std::holds_alternative<double levels::ReferenceError::*>(column.figure);
    if (of_reference && std::exchange(undecided, false) && !cells.empty()) row.error.emplace();
    std::visit(Read{cells, row}, column.figure);
  }
  cells.expect_end();
  return row;
}

} // namespace

const StepColumns& step_columns() {
  static const StepColumns columns(std::begin(levels::all_step_columns), std::end(levels::all_step_columns));
  return columns;
}

std::vector<std::string> step_header(const StepColumns& columns) {
  std::vector<std::string> names;
  for (const levels::StepColumn& column : columns) names.emplace_back(column.name);
  return names;
}

void write_row(files::CsvWriter& table, const levels::StepRow& row, const StepColumns& columns) {
  for (const levels::StepColumn& column : columns) std::visit(Write{table, row}, column.figure);
  table.end_row();
}

void each_row(const std::filesystem::path& table, std::uint64_t bytes, const StepColumns& columns,
              const std::function<void(const levels::StepRow&)>& use) {
  std::ifstream file(table, std::ios::binary);
  int number = 0;
  for (std::string line; bytes > 0 && std::getline(file, line); bytes -= std::min(bytes, line.size() + 1))
    if (++number > 1) use(row_of(Cells(line, table.string(), number), columns));
}

std::vector<levels::StepRow> read_rows(const std::filesystem::path& table, std::uint64_t bytes,
                                       const StepColumns& columns) {
  std::vector<levels::StepRow> rows;
  each_row(table, bytes, columns, [&](const levels::StepRow& row) { rows.push_back(row); });
  return rows;
}

} // namespace hopmesh::run
