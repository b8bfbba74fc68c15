// What is kept in memory of a motion's steps: every row of a short motion; of a long one evenly picked rows
// and exact totals, so that a million steps take no more room than some ten thousand.
#pragma once

#include "sim/run/unrest.h"

namespace hopmesh::run {

class StepLog {
 public:
  /// Where more come, every second one is dropped.
  static constexpr std::size_t most_kept = std::size_t{1} << 15;

  StepLog();
  void push_back(const levels::StepRow& row);

  std::uint64_t size() const { return steps_; } ///< steps, kept or not
  bool empty() const { return steps_ == 0; }
  const levels::StepRow& front() const { return kept_.front(); }
  const levels::StepRow& back() const { return last_; }
  /// The first step and every stride()-th after it.
  const StepRows& kept() const { return kept_; }
  std::uint64_t stride() const { return stride_; }

  /// As total_of() all rows. Only a median is one of the kept rows.
  double total(const levels::StepFigure& figure, levels::Summary how) const;
  /// Most cycles of array and bus together in a step.
  std::uint64_t slowest() const { return slowest_; }
  const UnrestCount& unrest() const { return unrest_; }

 private:
  /// Of a column over all steps that have its figure.
  struct Sums {
    double sum = 0, squares = 0, largest = 0, zeros = 0, count = 0;
  };
  void thin();

  std::uint64_t steps_ = 0, stride_ = 1, slowest_ = 0;
  StepRows kept_;
  levels::StepRow last_;
  UnrestCount unrest_;
  std::vector<Sums> sums_; ///< [step_columns()]
};

/// The totals of run_totals.h, of all steps of a log.
bool is_judged(const StepLog& log);
double total_of(const StepLog& log, const levels::StepFigure& figure, levels::Summary how);
std::uint64_t count_of(const StepLog& log, const levels::StepFigure& figure, levels::Summary how);
std::vector<RunTotal> totals_about(levels::Subject subject, const StepLog& log);
std::uint64_t neuron_updates(const StepLog& log, const levels::BuiltMesh& mesh);
inline std::string unrest_text(const StepLog& log) {
  return log.unrest().text();
}

} // namespace hopmesh::run
