// A column of steps.csv is a line of its table: file, totals and curves follow it.
#include "sim/run/run_picture.h"
#include "tests/support/files.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using levels::ReferenceError;
using levels::StepRow;
using levels::Subject;
using levels::Summary;
using ::testing::ElementsAre;

run::StepRows some_rows() {
  run::StepRows rows(4);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].sweeps = 10 + k;
    rows[k].converged = k > 0;
    rows[k].max_strain = 0.5 / static_cast<double>(k + 1);
    rows[k].alternation = 0.25 * static_cast<double>(k);
    rows[k].hash = k;
  }
  return rows;
}

/// A line, and nothing else, for a member that has no column so far.
run::StepColumns with_own_column() {
  run::StepColumns columns = run::step_columns();
  columns.insert(columns.begin() + 3,
                 levels::StepColumn("alternation", "", "share of a swing that is left", &StepRow::alternation,
                                    Subject::relaxation, levels::Curve{"swing left", "%", 100},
                                    levels::Total{Summary::largest, "largest_alternation",
                                                  "largest swing left", "{:.0f} %", 100}));
  return columns;
}

TEST(StepColumns, OneOfYourOwnIsWrittenAndReadBack) {
  const Folder folder;
  const run::StepColumns columns = with_own_column();
  files::CsvWriter table(folder / "steps.csv", run::step_header(columns));
  for (const StepRow& row : some_rows()) run::write_row(table, row, columns);
  table.commit();
  const std::string text = content_of(folder / "steps.csv");
  EXPECT_EQ(text.rfind("step,time,sweeps,alternation,cycles,", 0), 0u) << text;
  const run::StepRows again = run::read_rows(folder / "steps.csv", text.size(), columns);
  ASSERT_EQ(again.size(), 4u);
  EXPECT_EQ(again[3].alternation, 0.75);
  EXPECT_EQ(again[3].sweeps, 13u);
  EXPECT_THROW(run::read_rows(folder / "steps.csv", text.size()), input::InputError) << "a column too many";
}

TEST(StepColumns, OneOfYourOwnIsSummedUpAmongThoseOfItsSubject) {
  const auto totals = run::totals_about(Subject::relaxation, some_rows(), with_own_column());
  ASSERT_EQ(totals.size(), 3u);
  EXPECT_STREQ(totals[2].total->key, "largest_alternation");
  EXPECT_EQ(totals[2].value, 0.75);
  EXPECT_EQ(totals[2].text(), "75 %");
}

TEST(StepColumns, OneOfYourOwnIsDrawn) {
  run::RunFacts facts;
  facts.level = &levels::default_level();
  const auto series = run::series_of(facts, some_rows(), with_own_column());
  ASSERT_GT(series.size(), 1u);
  EXPECT_EQ(series[1].name, "swing left");
  EXPECT_EQ(series[1].unit, "%");
  EXPECT_THAT(series[1].values, ElementsAre(0, 25, 50, 75));
}

TEST(StepTotals, AreWhatTheySay) {
  run::StepRows rows = some_rows();
  EXPECT_EQ(run::count_of(rows, &StepRow::sweeps, Summary::sum), 46u);
  EXPECT_EQ(run::count_of(rows, &StepRow::sweeps, Summary::largest), 13u);
  EXPECT_EQ(run::count_of(rows, &StepRow::converged, Summary::unmet), 1u);
  EXPECT_EQ(run::total_of(rows, &StepRow::max_strain, Summary::largest), 0.5);
  EXPECT_EQ(run::total_of(rows, &ReferenceError::rms_output, Summary::median), 0) << "nobody was asked";
  const double errors[] = {5, 1, 3, 1};
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].error.emplace().rms_output = errors[k];
  EXPECT_EQ(run::total_of(rows, &ReferenceError::rms_output, Summary::rms), 3); // (25 + 1 + 9 + 1) / 4
  rows.push_back(rows[2]);
  EXPECT_EQ(run::total_of(rows, &ReferenceError::rms_output, Summary::median), 3); // 1 1 3 3 5
}

TEST(StepTotals, OfWhatNeverRisesAboveZeroIsZero) {
  run::StepRows rows(2);
  for (StepRow& row : rows) row.error.emplace().energy_gap = -1;
  EXPECT_EQ(run::total_of(rows, &ReferenceError::energy_gap, Summary::largest), 0);
}

TEST(StepTotals, StandMediansBeforeLargestValues) {
  run::StepRows rows(1);
  rows[0].error.emplace().rms_output = 0.5;
  std::vector<std::string> keys;
  for (const run::RunTotal& t : run::totals_about(Subject::reference, rows)) keys.emplace_back(t.total->key);
  EXPECT_THAT(keys, ElementsAre("median_output_error_rms", "median_rounding_error", "median_stopping_error",
                                "median_energy_gap", "largest_output_error", "largest_energy_gap",
                                "largest_network_error"));
}

TEST(StepTotals, ShowCountsInGroups) {
  run::StepRows rows(1);
  rows[0].sweeps = 1234567;
  EXPECT_EQ(run::totals_about(Subject::relaxation, rows).at(0).text(), "1,234,567");
}

TEST(Outcomes, AreFoundByTheirNames) {
  for (const std::string_view name : run::outcome_names) {
    ASSERT_TRUE(run::outcome_named(name)) << name;
    EXPECT_EQ(name_of(*run::outcome_named(name)), name);
  }
  EXPECT_FALSE(run::outcome_named("Finished"));
}

} // namespace
} // namespace hopmesh::tests
