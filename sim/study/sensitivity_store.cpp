#include "sim/study/sensitivity_store.h"

#include "sim/levels/interrupt.h"
#include "sim/study/claimed_table.h"
#include "sim/study/reference_store.h"
#include "sim/study/twin.h"

#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> sensitivity_columns{"time", "sensitivity"};

std::vector<Maybe> saved(const fs::path& file, std::size_t times) {
  const files::CsvTable table = files::read_kept(file, sensitivity_columns);
  if (table.rows.size() != times)
    throw damaged_cell(file, 0, "", fmt::format("{} rows", table.rows.size()), std::to_string(times));
  std::vector<Maybe> at;
  for (std::size_t k = 0; k < times; ++k) {
    at.push_back(table.number(k, sensitivity_columns[1]));
    const std::string& text = table.text(k, sensitivity_columns[1]);
    if (!text.empty() && !(at[k] && *at[k] >= 0))
      throw damaged_cell(file, k, sensitivity_columns[1], input::in_quotes(text), "a distance");
  }
  return at;
}

} // namespace

std::vector<Maybe> SensitivityStore::at(const scene::Inputs& inputs, const levels::BuiltMesh& mesh,
                                        const std::vector<double>& times) const {
  const auto steps = static_cast<std::uint64_t>(inputs.scene.motion.steps);
  const fs::path file =
      folder_ / fmt::format("sensitivity-{:016x}.csv", reference_hash(inputs, mesh, times, steps));
  std::optional<files::CsvWriter> table = claim_table(file, sensitivity_columns);
  if (!table) return levels::stop_requested ? std::vector<Maybe>(times.size()) : saved(file, times.size());
  std::vector<Maybe> at = sensitivity_of(inputs, mesh, times, levels::stop_requested);
  if (levels::stop_requested) return at;
  for (std::size_t k = 0; k < times.size(); ++k) table->cell(times[k]).cell(at[k]).end_row();
  table->commit();
  return at;
}

} // namespace hopmesh::study
