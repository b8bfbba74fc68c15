#include "sim/study/size/trial_folder.h"

#include "sim/files/csv.h"
#include "sim/input/input_error.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hopmesh::study {

namespace {

const std::vector<std::string> columns{"status", "error", "sweeps", "most_sweeps", "cycles", "most_cycles"};

std::uint64_t count(const files::CsvTable& table, const char* name) {
  return static_cast<std::uint64_t>(table.number(0, name).value_or(0));
}

std::string name_of(const Setting& setting) {
  return fmt::format("{}", fmt::join(setting, "-"));
}

} // namespace

TrialFolder::TrialFolder(const std::filesystem::path& folder, std::uint64_t hash)
    : safe_(folder, "trials",
            {"size.hash", hash, "trials of another scene, array or length", "a folder of its own"}, true) {}

std::optional<TrialRow> TrialFolder::find(const Setting& setting) const {
  const std::string name = name_of(setting);
  if (!safe_.has(name)) return std::nullopt;
  const files::CsvTable table = safe_.row(name, columns);
  const auto outcome = run::outcome_named(table.text(0, "status"));
  if (!outcome)
    throw input::input_error(safe_.file(name).string(), 1, "status", table.text(0, "status"),
                             "how a run ends");
  TrialRow row;
  row.outcome = *outcome;
  row.error = table.number(0, "error").value_or(HUGE_VAL);
  row.sweeps = count(table, "sweeps"), row.most_sweeps = count(table, "most_sweeps");
  row.cycles = count(table, "cycles"), row.most_cycles = count(table, "most_cycles");
  return row;
}

void TrialFolder::save(const Setting& setting, const TrialRow& row) const {
  files::CsvWriter table(safe_.file(name_of(setting)), columns);
  table.cell(run::name_of(row.outcome)).cell(row.error).cell(row.sweeps).cell(row.most_sweeps);
  table.cell(row.cycles).cell(row.most_cycles).end_row();
  table.commit();
}

} // namespace hopmesh::study
