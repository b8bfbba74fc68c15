#include "sim/study/trial_folder.h"

#include "sim/files/csv.h"
#include "sim/files/csv_table.h"
#include "sim/input/whole_file.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> columns{"status", "error", "sweeps", "most_sweeps", "cycles", "most_cycles"};

std::uint64_t count(const files::CsvTable& table, const char* name) {
  return static_cast<std::uint64_t>(table.number(0, name).value_or(0));
}

} // namespace

TrialFolder::TrialFolder(fs::path folder, std::uint64_t hash) : folder_(std::move(folder)) {
  files::check_writable(folder_, 0);
  lock_.emplace(folder_);
  const fs::path mark = folder_ / "size.hash";
  const std::string text = fmt::format("{:016x}\n", hash);
  if (!fs::exists(mark)) {
    files::check_writable(folder_ / "trials", 0);
    files::write_file(mark, text);
  } else if (input::read_whole_file(mark.string(), "a search's hash", 1000) != text) {
    throw input::input_error(folder_.string(), 0, "--out", "trials of another scene, array or length",
                             "a folder of its own");
  }
}

fs::path TrialFolder::file_of(const Setting& setting) const {
  return folder_ / "trials" / fmt::format("{}.csv", fmt::join(setting, "-"));
}

std::optional<TrialRow> TrialFolder::find(const Setting& setting) const {
  const fs::path file = file_of(setting);
  if (!fs::exists(file)) return std::nullopt;
  const files::CsvTable table = files::read_csv(file);
  const bool whole = table.header == columns && table.rows.size() == 1;
  const auto outcome = whole ? run::outcome_named(table.text(0, "status")) : std::nullopt;
  if (!outcome) throw input::input_error(file.string(), 1, "", "no trial", "a trial's row");
  TrialRow row;
  row.outcome = *outcome;
  row.error = table.number(0, "error").value_or(HUGE_VAL);
  row.sweeps = count(table, "sweeps"), row.most_sweeps = count(table, "most_sweeps");
  row.cycles = count(table, "cycles"), row.most_cycles = count(table, "most_cycles");
  return row;
}

void TrialFolder::keep(const Setting& setting, const TrialRow& row) const {
  files::CsvWriter table(file_of(setting), columns);
  table.cell(name_of(row.outcome)).cell(row.error).cell(row.sweeps).cell(row.most_sweeps);
  table.cell(row.cycles).cell(row.most_cycles).end_row();
  table.commit();
}

} // namespace hopmesh::study
