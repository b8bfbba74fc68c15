#include "sim/run/run_totals.h"

#include "sim/input/count_text.h"
#include "sim/run/array_info.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <sys/resource.h>

namespace hopmesh::run {

namespace {

using levels::Summary;

struct Value {
  const levels::StepRow& row;

  template <class Number> std::optional<double> operator()(Number levels::StepRow::*member) const {
    return static_cast<double>(row.*member);
  }
  std::optional<double> operator()(std::optional<double> levels::StepRow::*member) const {
    return row.*member;
  }
  std::optional<double> operator()(levels::HashFigure) const { return std::nullopt; }
  std::optional<double> operator()(double levels::ReferenceError::*member) const {
    return row.error ? std::optional((*row.error).*member) : std::nullopt;
  }
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, value); // passes over what is no number
  return most;
}

double rms(const std::vector<double>& values) {
  const double squares = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

bool is_count(const levels::StepFigure& figure, Summary how) {
  return how != Summary::rms && (std::holds_alternative<std::uint64_t levels::StepRow::*>(figure) ||
                                 std::holds_alternative<bool levels::StepRow::*>(figure));
}

} // namespace

bool is_judged(const StepRows& rows) {
  return !rows.empty() && rows.front().error.has_value();
}

std::optional<double> value_of(const levels::StepRow& row, const levels::StepFigure& figure) {
  return std::visit(Value{row}, figure);
}

double total_of(const StepRows& rows, const levels::StepFigure& figure, Summary how) {
  std::vector<double> values;
  for (const levels::StepRow& row : rows)
    if (const auto value = value_of(row, figure)) values.push_back(*value);
  if (values.empty()) return 0;
  switch (how) {
  case Summary::sum:
    return std::accumulate(values.begin(), values.end(), 0.0);
  case Summary::unmet:
    return static_cast<double>(std::count(values.begin(), values.end(), 0.0));
  case Summary::rms:
    return rms(values);
  case Summary::median:
    return median(std::move(values));
  case Summary::largest:
    return largest(values);
  }
  return 0;
}

std::uint64_t count_of(const StepRows& rows, const levels::StepFigure& figure, Summary how) {
  return static_cast<std::uint64_t>(total_of(rows, figure, how));
}

std::string RunTotal::text() const {
  const double shown = total->factor * value;
  if (is_count)
    return fmt::format(fmt::runtime(total->format), input::grouped(static_cast<std::uint64_t>(shown)));
  return fmt::format(fmt::runtime(total->format), shown);
}

std::vector<RunTotal> totals_about(levels::Subject subject, const StepRows& rows,
                                   const StepColumns& columns) {
  return totals_about(subject, columns, [&](const levels::StepFigure& figure, Summary how) {
    return total_of(rows, figure, how);
  });
}

std::vector<RunTotal> totals_about(levels::Subject subject, const StepColumns& columns,
                                   const TotalMaker& total_by) {
  std::vector<RunTotal> all;
  for (const levels::StepColumn& column : columns)
    for (const levels::Total& total : column.totals)
      if (column.subject == subject && total.key) {
        const double value = total_by(column.figure, total.how);
        if (subject == levels::Subject::certainty && value == 0) continue; // no row has it
        all.push_back({&total, is_count(column.figure, total.how), value});
      }
  std::stable_sort(all.begin(), all.end(),
                   [](const RunTotal& a, const RunTotal& b) { return a.total->how < b.total->how; });
  return all;
}

bool same_figure(const levels::StepFigure& a, const levels::StepFigure& b) {
  const auto same = [&](const auto& member) { return member == std::get<std::decay_t<decltype(member)>>(b); };
  return a.index() == b.index() && std::visit(same, a);
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

} // namespace hopmesh::run
