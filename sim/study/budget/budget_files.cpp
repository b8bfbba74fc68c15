// A budget as people read it, as a table and as a picture.
#include "sim/files/csv.h"
#include "sim/levels/exact_step.h"
#include "sim/pictures/svg_bars.h"
#include "sim/study/budget/budget.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

std::vector<std::string> parts_of(const Budget& budget) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k + 1 < budget.chain.size(); ++k) names.push_back(budget.chain[k].mends);
  return names;
}

void write_table(const std::filesystem::path& file, const Budget& budget) {
  std::vector<std::string> columns{"time", "total", "truth_floor", "sensitivity"};
  for (std::string name : parts_of(budget)) {
    std::replace(name.begin(), name.end(), ' ', '_');
    columns.push_back(name);
    columns.push_back(name + "_share");
  }
  files::CsvWriter table(file, columns);
  for (const BudgetAt& row : budget.rows) {
    table.cell(row.time).cell(row.total).cell(row.floor).cell(row.sensitivity);
    for (const auto& part : row.parts) table.cell(part.norm).cell(part.share);
    table.end_row();
  }
  table.commit();
}

pictures::StackedBars picture_of(const levels::Prepared& p, const Budget& budget) {
  pictures::StackedBars bars;
  bars.title = p.inputs.scene.name + ": where the distance from the truth comes from";
  bars.note = fmt::format("array {}; Δt = {} s", p.inputs.array.name, p.inputs.scene.motion.time_step);
  bars.x_label = "time, s", bars.y_label = "rms over nodes, m";
  bars.stacked_title = "shares: what is above 0 less what is below is the whole";
  bars.length_title = "each part by itself";
  bars.floor_name = "truth floor";
  for (const std::string& name : parts_of(budget)) bars.parts.push_back({name, {}, {}});
  for (const BudgetAt& row : budget.rows) {
    bars.x.push_back(row.time);
    bars.floor.push_back(row.floor);
    for (std::size_t k = 0; k < row.parts.size(); ++k) {
      bars.parts[k].stacked.push_back(row.parts[k].share * row.total);
      bars.parts[k].length.push_back(row.parts[k].norm);
    }
  }
  return bars;
}

std::string row_lines(const Budget& budget) {
  std::string lines =
      fmt::format("Rms over nodes, m, and share of the whole (by projection: shares add up to 100 %)\n"
                  "{:>9}{:>11}{:>11}{:>13}",
                  "time, s", "whole", "floor", "sensitivity");
  for (const std::string& name : parts_of(budget)) lines += fmt::format("{:>24}", name);
  for (const BudgetAt& row : budget.rows) {
    lines += fmt::format("\n{:>9.4g}{:>11.2e}{:>11.1e}{:>13}", row.time, row.total, row.floor,
                         row.sensitivity ? fmt::format("{:.1e}", *row.sensitivity) : "");
    for (const auto& part : row.parts)
      lines += fmt::format("{:>13.2e}{:>+9.1f} %", part.norm, 100 * part.share);
  }
  return lines + '\n';
}

/// From where on the array's part is no larger than what the last place of the start makes.
std::string undecided_text(const Budget& budget) {
  for (const BudgetAt& row : budget.rows)
    if (row.sensitivity && *row.sensitivity > 0 && row.parts[0].norm <= *row.sensitivity)
      return fmt::format("From {:.4g} s on the motion does not decide {}: two references that start a last "
                         "place apart differ by as much.\n",
                         row.time, budget.chain[0].mends);
  return "";
}

} // namespace

std::string text_of(const levels::Prepared& p, const Budget& budget) {
  std::string text = p.inputs.scene.name + ": whose part of the distance from the truth is how large\n";
  for (std::size_t k = 0; k + 1 < budget.chain.size(); ++k)
    text += fmt::format("  {:<22} {}\n  {:<22} less {}\n", budget.chain[k].mends, budget.chain[k].motion, "",
                        budget.chain[k + 1].motion);
  if (!levels::ExactStep::exists_for(p.inputs.scene))
    text += "The probe has no exact step that tends to this physics, so its time step has no part of its "
            "own: formulation\nis all that lies between its rest and the truth.\n";
  if (!budget.rows.empty()) text += row_lines(budget) + undecided_text(budget);
  for (const std::string& trouble : budget.troubles) text += trouble + '\n';
  return text;
}

void write_budget(const std::filesystem::path& folder, const levels::Prepared& p, const Budget& budget) {
  write_table(folder / "budget.csv", budget);
  files::write_file(folder / "budget.svg", pictures::svg_of(picture_of(p, budget)));
}

} // namespace hopmesh::study
