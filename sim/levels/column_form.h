// What a column of steps.csv is, and what is made of it as a whole: figures for stats.json and the report,
// and a curve.
#pragma once

#include "sim/levels/step_row.h"

#include <variant>

namespace hopmesh::levels {

/// A figure made of a whole column. The totals of a subject are shown in this order.
enum class Summary {
  sum,
  unmet, ///< of a condition: the steps in which it did not hold
  rms,
  median,
  largest ///< 0 where nothing is above
};

struct Total {
  Summary how = Summary::sum;
  const char* key = nullptr;    ///< in stats.json; null: this is no total
  const char* name = nullptr;   ///< in the report; null where another line there says it
  const char* format = nullptr; ///< of its value in the report, as {fmt} has it; a count comes as "12,345"
  double factor = 1;            ///< the report shows so many times the figure: 100 for a share in percent
};

/// A chart of the report.
struct Curve {
  const char* name = nullptr; ///< null: this is no curve
  const char* unit = "";
  double factor = 1; ///< as `Total::factor`
};

/// A figure that stands in its cell as 16 hexadecimal digits.
struct HashFigure {
  std::uint64_t StepRow::*member;
  bool operator==(const HashFigure& other) const { return member == other.member; }
};

/// Where a row keeps the figure of a column.
using StepFigure = std::variant<std::uint64_t StepRow::*, double StepRow::*, bool StepRow::*,
                                std::optional<double> StepRow::*, HashFigure, double ReferenceError::*>;

/// What a column is about. Statistics and report show its totals and its curve only where a run has that.
enum class Subject {
  motion,
  relaxation, ///< of a network
  rest,       ///< how near it came
  glance,     ///< how near the host sees at least that it did not come
  correction, ///< of answers by their residuals
  clock,      ///< of a simulated array
  arithmetic, ///< of a host that has no doubles
  host,       ///< whose instructions are counted
  network,    ///< as loaded into an array
  reference,  ///< the array's answers against it
  certainty   ///< what is known of them without a rest
};

struct StepColumn {
  constexpr StepColumn(const char* called, const char* measured_in, const char* meaning, StepFigure of,
                       Subject about, Curve drawn = {}, Total first = {}, Total second = {})
      : name(called), unit(measured_in), words(meaning), figure(of), subject(about),
        curve(drawn), totals{first, second} {}

  const char *name, *unit;
  const char* words; ///< its meaning, as the docs print it
  StepFigure figure;
  Subject subject;
  Curve curve;
  Total totals[2];
};

} // namespace hopmesh::levels
