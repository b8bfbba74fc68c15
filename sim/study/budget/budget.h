// Whose part of a run's distance from the truth is how large: the whole of `budget`.
#pragma once

#include "sim/levels/prepared.h"
#include "sim/study/budget/error_budget.h"

#include <filesystem>
#include <optional>

namespace hopmesh::study {

/// A motion of the chain, and what the next one mends.
struct BudgetLink {
  std::string motion, mends;
  std::vector<run::Positions> at; ///< [times]
};

struct Budget {
  std::vector<double> times;     ///< s
  std::vector<BudgetLink> chain; ///< the truth, which mends nothing, is its last
  std::vector<double> floor;
  std::vector<std::optional<double>> sensitivity; ///< [times]
  std::vector<std::string> troubles;              ///< in sentences
  std::vector<BudgetAt> rows;                     ///< where everybody came to
};

/// Makes sure before any work that a truth is known, and that the folder can be written to. Throws
/// input::InputError and files::WriteError.
void check_budget(const levels::Prepared& prepared, const std::filesystem::path& folder);
/// Flies the chain; the truth lies in the folder. None where the user stopped it.
std::optional<Budget> work_out_budget(const levels::Prepared& prepared, const std::filesystem::path& folder);

/// In lines for people.
std::string text_of(const levels::Prepared& prepared, const Budget& budget);
/// budget.csv and budget.svg.
void write_budget(const std::filesystem::path& folder, const levels::Prepared& prepared,
                  const Budget& budget);

} // namespace hopmesh::study
