#include "sim/study/study_folder.h"

#include "sim/files/csv.h"
#include "sim/files/csv_table.h"
#include "sim/input/whole_file.h"

#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

void cell(files::CsvWriter& table, const Maybe& value) {
  if (value)
    table.cell(*value);
  else
    table.cell("");
}

void write(files::CsvWriter& table, const Point& point, const PointRow& row) {
  table.cell(point.number);
  for (const std::string& label : point.labels) table.cell(label);
  table.cell(point.method).cell(row.status).cell(name_of(row.stability));
  cell(table, row.output_error), cell(table, row.output_error_median), cell(table, row.position_error);
  for (const Maybe& error : row.reference_at) cell(table, error);
  for (const Maybe& error : row.truth_at) cell(table, error);
  for (const Maybe& floor : row.floor_at) cell(table, floor);
  table.cell(row.steps).cell(row.sweeps).cell(row.cycles).cell(row.bus_cycles).cell(row.array_seconds);
  table.cell(row.host_seconds).cell(row.multiplies).cell(row.memory_bits).cell(row.largest_strain);
  table.cell(row.omega).cell(row.sentence).cell(point.command).end_row();
}

} // namespace

std::vector<std::string> result_columns(const Study& study) {
  std::vector<std::string> columns{"point"};
  for (const StudyAxis& axis : study.axes) columns.push_back(axis.name);
  for (const char* name :
       {"method", "status", "class", "output_error", "output_error_median", "position_error"})
    columns.emplace_back(name);
  for (const char* kind : {"reference_error", "truth_error", "truth_floor"})
    for (double time : study.times) columns.push_back(fmt::format("{}@{}", kind, time));
  for (const char* name : {"steps", "sweeps", "cycles", "bus_cycles", "array_seconds", "host_seconds",
                           "multiplies", "memory_bits", "largest_strain", "omega", "sentence", "command"})
    columns.emplace_back(name);
  return columns;
}

StudyFolder::StudyFolder(const Study& study, fs::path folder, std::uint64_t hash, bool alone)
    : study_(study), folder_(std::move(folder)) {
  files::check_writable(folder_, 0);
  if (alone) lock_.emplace(folder_);
  const fs::path mark = folder_ / "study.hash";
  const std::string text = fmt::format("{:016x}\n", hash);
  if (!fs::exists(mark)) {
    files::check_writable(folder_ / "points", 0);
    files::write_file(folder_ / "study.toml", study.text);
    files::write_file(mark, text);
  } else if (input::read_whole_file(mark.string(), "a study's hash", 1000) != text) {
    throw input::input_error(folder_.string(), 0, "--out",
                             "the results of another study, or of this one before a change",
                             "a folder of its own, or the study as it was (study.toml there)");
  }
}

fs::path StudyFolder::file_of(std::size_t number) const {
  return folder_ / "points" / fmt::format("{}.csv", number);
}

bool StudyFolder::has(std::size_t number) const {
  return fs::exists(file_of(number));
}

std::vector<std::size_t> StudyFolder::missing() const {
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < study_.combinations(); ++n)
    if (!has(n)) numbers.push_back(n);
  return numbers;
}

void StudyFolder::keep(const Point& point, const PointRow& row) const {
  PointRow full = row; // a crash leaves errors open, but not their columns
  full.reference_at.resize(study_.times.size());
  full.truth_at.resize(study_.times.size());
  full.floor_at.resize(study_.times.size());
  files::CsvWriter table(file_of(point.number), result_columns(study_));
  write(table, point, full);
  table.commit();
}

std::map<std::string, std::size_t> StudyFolder::collect() const {
  std::map<std::string, std::size_t> count;
  const auto columns = result_columns(study_);
  files::CsvWriter all(folder_ / "results.csv", columns);
  for (std::size_t n = 0; n < study_.combinations(); ++n) {
    const files::CsvTable one = files::read_csv(file_of(n));
    if (one.header != columns || one.rows.size() != 1)
      throw input::input_error(file_of(n).string(), 1, "", "no row of this study", "a point's row");
    for (const std::string& text : one.rows[0]) all.cell(text);
    all.end_row();
    ++count[one.text(0, "status")];
  }
  all.commit();
  return count;
}

} // namespace hopmesh::study
