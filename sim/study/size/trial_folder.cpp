#include "sim/study/size/trial_folder.h"

#include "sim/input/number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hopmesh::study {

namespace {

const std::vector<std::string> trial_columns{"status", "error",      "sweeps",     "most_sweeps",
                                             "cycles", "bus_cycles", "most_cycles"};

std::string name_of(const Setting& setting) {
  return fmt::format("{}", fmt::join(setting, "-"));
}

} // namespace

TrialFolder::TrialFolder(const std::filesystem::path& folder, std::uint64_t hash)
    : safe_(folder, "trials",
            {"size.hash", hash, "trials of another scene, array or length", "a folder of its own"},
            trial_columns, true) {}

std::optional<TrialRow> TrialFolder::find(const Setting& setting) const {
  const std::string name = name_of(setting);
  if (!safe_.has(name)) return std::nullopt;
  const files::CsvTable table = safe_.row(name);
  const auto take = [&](const char* column, auto& number) {
    const std::string& text = table.text(0, column);
    if (!input::parse_number(text, number))
      throw safe_.damaged(name, input::in_quotes(text), "a number", column);
  };
  TrialRow row;
  const auto outcome = run::outcome_named(table.text(0, "status"));
  if (!outcome)
    throw safe_.damaged(name, input::in_quotes(table.text(0, "status")), "how a run ends", "status");
  row.outcome = *outcome;
  take("error", row.error);
  take("sweeps", row.sweeps), take("most_sweeps", row.most_sweeps);
  take("cycles", row.cycles), take("bus_cycles", row.bus_cycles), take("most_cycles", row.most_cycles);
  if (!(row.error >= 0)) throw safe_.damaged(name, table.text(0, "error"), "a distance", "error");
  return row;
}

void TrialFolder::save(const Setting& setting, const TrialRow& row) const {
  files::CsvWriter table = safe_.writer(name_of(setting));
  table.cell(run::name_of(row.outcome)).cell(row.error).cell(row.sweeps).cell(row.most_sweeps);
  table.cell(row.cycles).cell(row.bus_cycles).cell(row.most_cycles).end_row();
  table.commit();
}

} // namespace hopmesh::study
