#include "sim/run/step_table.h"

#include "sim/input/input_error.h"

#include <charconv>
#include <fmt/format.h>
#include <fstream>

namespace hopmesh::run {

namespace {

/// The cells of one line, taken from left to right.
class Cells {
 public:
  Cells(std::string_view line, std::string file, int number)
      : rest_(line), file_(std::move(file)), number_(number) {}

  bool empty() const { return rest_.empty() || rest_.front() == ','; }

  template <class Number> void take(Number& value) {
    const std::string_view cell = next();
    const auto [stop, failure] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    expect(failure == std::errc() && stop == cell.data() + cell.size(), cell, "a number");
  }
  void take(bool& value) {
    const std::string_view cell = next();
    expect(cell == "0" || cell == "1", cell, "0 or 1");
    value = cell == "1";
  }
  void take_hash(std::uint64_t& value) {
    const std::string_view cell = next();
    const auto [stop, failure] = std::from_chars(cell.data(), cell.data() + cell.size(), value, 16);
    expect(failure == std::errc() && stop == cell.data() + cell.size(), cell, "a hash");
    expect(done_, rest_, "the end of the line");
  }
  void pass_empty() { expect(next().empty(), "a value", "an empty cell"); }

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

levels::StepRow row_of(Cells cells) {
  levels::StepRow row;
  cells.take(row.step), cells.take(row.time), cells.take(row.sweeps), cells.take(row.cycles);
  cells.take(row.energy), cells.take(row.kinetic), cells.take(row.max_strain), cells.take(row.saturated);
  cells.take(row.converged), cells.take(row.max_stretch), cells.take(row.bus_cycles), cells.take(row.clipped);
  if (!cells.empty()) {
    levels::ReferenceError& error = row.error.emplace();
    cells.take(error.largest_output), cells.take(error.rms_output);
    cells.take(error.energy_gap), cells.take(error.network);
  } else {
    for (int k = 0; k < 4; ++k) cells.pass_empty();
  }
  cells.take_hash(row.hash);
  return row;
}

} // namespace

const std::vector<std::string>& step_columns() {
  static const std::vector<std::string> columns{
      "step",          "time",       "sweeps",       "cycles",           "energy",
      "kinetic",       "max_strain", "saturated",    "converged",        "max_stretch",
      "bus_cycles",    "clipped",    "output_error", "output_error_rms", "energy_gap",
      "network_error", "hash"};
  return columns;
}

void write_row(files::CsvWriter& table, const levels::StepRow& row) {
  table.cell(row.step).cell(row.time).cell(row.sweeps).cell(row.cycles).cell(row.energy).cell(row.kinetic);
  table.cell(row.max_strain).cell(row.saturated).cell(row.converged).cell(row.max_stretch);
  table.cell(row.bus_cycles).cell(row.clipped);
  if (row.error)
    table.cell(row.error->largest_output)
        .cell(row.error->rms_output)
        .cell(row.error->energy_gap)
        .cell(row.error->network);
  else
    table.cell("").cell("").cell("").cell("");
  table.cell(fmt::format("{:016x}", row.hash)).end_row();
}

std::vector<levels::StepRow> read_rows(const std::filesystem::path& table, std::uint64_t bytes) {
  std::ifstream file(table, std::ios::binary);
  std::vector<levels::StepRow> rows;
  int number = 0;
  for (std::string line; bytes > 0 && std::getline(file, line); bytes -= std::min(bytes, line.size() + 1))
    if (++number > 1) rows.push_back(row_of(Cells(line, table.string(), number)));
  return rows;
}

} // namespace hopmesh::run
