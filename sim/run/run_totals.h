// The steps of a motion summed up: for stats.json, the report, comparisons and studies alike.
#pragma once

#include "sim/run/step_table.h"

#include <functional>

namespace hopmesh::run {

using StepRows = std::vector<levels::StepRow>;

/// The reference was asked beside the steps.
bool is_judged(const StepRows& rows);

/// A figure of one row; none where the reference was not asked, or where it is a hash.
std::optional<double> value_of(const levels::StepRow& row, const levels::StepFigure& figure);

/// A figure of all rows that have it, in one number; 0 where none has. Counts are exact up to 2^53.
double total_of(const StepRows& rows, const levels::StepFigure& figure, levels::Summary how);
std::uint64_t count_of(const StepRows& rows, const levels::StepFigure& figure, levels::Summary how);

/// A total of the table with its value.
struct RunTotal {
  const levels::Total* total;
  bool is_count;
  double value;

  std::string text() const; ///< for the report
};

/// All totals of the columns about a subject, in the order of Summary, then of the columns.
std::vector<RunTotal> totals_about(levels::Subject subject, const StepRows& rows,
                                   const StepColumns& columns = step_columns());

/// As `total` has them.
using TotalMaker = std::function<double(const levels::StepFigure&, levels::Summary)>;
std::vector<RunTotal> totals_about(levels::Subject subject, const StepColumns& columns,
                                   const TotalMaker& total);

/// A figure of a row is the one of another.
bool same_figure(const levels::StepFigure& a, const levels::StepFigure& b);

double peak_memory_mb(); ///< of this process so far

} // namespace hopmesh::run
