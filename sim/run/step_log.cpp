#include "sim/run/step_log.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::run {

using levels::Summary;

StepLog::StepLog() : sums_(step_columns().size()) {}

void StepLog::push_back(const levels::StepRow& row) {
  if (steps_ % stride_ == 0) kept_.push_back(row);
  last_ = row;
  ++steps_;
  slowest_ = std::max(slowest_, row.cycles + row.bus_cycles);
  unrest_.add(row);
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    const std::optional<double> value = value_of(row, step_columns()[k].figure);
    if (!value) continue;
    Sums& s = sums_[k];
    s.sum += *value;
    s.squares += *value * *value;
    s.largest = std::max(s.largest, *value); // passes over what is no number
    s.zeros += *value == 0;
    s.count += 1;
  }
  if (kept_.size() > most_kept) thin();
}

void StepLog::thin() {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < kept_.size(); k += 2) kept_[kept++] = kept_[k];
  kept_.resize(kept);
  stride_ *= 2;
}

double StepLog::total(const levels::StepFigure& figure, Summary how) const {
  const auto& columns = step_columns();
  const auto column = std::find_if(columns.begin(), columns.end(), [&](const levels::StepColumn& c) {
    return same_figure(c.figure, figure);
  });
  if (column == columns.end() || how == Summary::median) return total_of(kept_, figure, how);
  const Sums& s = sums_[static_cast<std::size_t>(column - columns.begin())];
  switch (how) {
  case Summary::sum:
    return s.sum;
  case Summary::unmet:
    return s.zeros;
  case Summary::rms:
    return s.count > 0 ? std::sqrt(s.squares / s.count) : 0;
  case Summary::largest:
    return s.largest;
  case Summary::median:
    break;
  }
  return 0;
}

bool is_judged(const StepLog& log) {
  return is_judged(log.kept());
}

double total_of(const StepLog& log, const levels::StepFigure& figure, Summary how) {
  return log.total(figure, how);
}

std::uint64_t count_of(const StepLog& log, const levels::StepFigure& figure, Summary how) {
  return static_cast<std::uint64_t>(log.total(figure, how));
}

std::vector<RunTotal> totals_about(levels::Subject subject, const StepLog& log) {
  return totals_about(subject, step_columns(),
                      [&](const levels::StepFigure& figure, Summary how) { return log.total(figure, how); });
}

std::uint64_t neuron_updates(const StepLog& log, const levels::BuiltMesh& mesh) {
  return count_of(log, &levels::StepRow::sweeps, Summary::sum) * mesh.topology().neurons();
}

} // namespace hopmesh::run
