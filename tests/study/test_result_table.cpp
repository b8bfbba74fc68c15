// A column of results.csv is a line of its table: header, cells and the roles of a chart follow it.
#include "sim/study/result_table.h"
#include "tests/support/files.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace study;

using ::testing::HasSubstr;
using ::testing::Not;

Study two_axes() {
  return study_of("scene = \"two-nodes\"\nsteps = 20\ntimes = [0.1, 0.2]\n[axes]\n\"probe.gamma\" = [1, 2]\n"
                  "\"array.lanes\" = [1]\n",
                  "s.toml");
}

Point some_point() {
  return {7, "engine", {"1", "2"}, {}, "hopmesh run \"x\", y"};
}

/// The file of one row: header and cells.
std::string file_of(const PointRow& row, const ResultColumns& columns = result_columns()) {
  const Folder folder;
  const Study study = two_axes();
  files::CsvWriter table(folder / "results.csv", result_header(study, columns));
  write_result(table, study, some_point(), row, columns);
  table.commit();
  return content_of(folder / "results.csv");
}

TEST(ResultTable, HasAColumnAnAxisAndAColumnATime) {
  EXPECT_EQ(file_of({}).substr(0, file_of({}).find("steps")),
            "point,probe.gamma,array.lanes,method,status,class,output_error,output_error_median,"
            "rounding_error,rounding_error_median,stopping_error,stopping_error_median,position_error,"
            "reference_error@0.1,reference_error@0.2,truth_"
            "error@0.1,truth_error@0.2,truth_floor@0.1,"
            "truth_floor@0.2,sensitivity@0.1,sensitivity@0.2,");
}

TEST(ResultTable, LeavesEmptyWhatIsNotKnown) {
  PointRow row;
  row.sentence = "killed";
  EXPECT_THAT(file_of(row), HasSubstr("\n7,1,2,engine,crashed,stable,,,,,,,,,,,,,,,,0,0,"));
  row.outcome = run::Outcome::finished;
  row.output_error = 0.5;
  row.truth_at = {std::nullopt, 0.25};
  EXPECT_THAT(file_of(row), HasSubstr("\n7,1,2,engine,finished,stable,0.5,,,,,,,,,,0.25,,,,,0,0,"));
}

/// A member of your own; a line of the table is all that its column takes.
struct OwnRow : PointRow {
  double heat = 0;
};

TEST(ResultTable, WritesAColumnOfYourOwn) {
  ResultColumns columns = result_columns();
  columns.insert(columns.begin() + 4,
                 {"heat", "J", "left behind", static_cast<double PointRow::*>(&OwnRow::heat), Role::work});
  OwnRow row;
  row.heat = 0.125;
  EXPECT_THAT(file_of(row, columns), HasSubstr(",method,status,heat,class,"));
  EXPECT_THAT(file_of(row, columns), HasSubstr("\n7,1,2,engine,crashed,0.125,stable,"));
  EXPECT_THAT(file_of(row), Not(HasSubstr("0.125")));
  EXPECT_EQ(column_headed("heat"), nullptr);
  ASSERT_TRUE(column_headed("heat", columns));
  EXPECT_EQ(column_headed("heat", columns)->role, Role::work);
}

TEST(ResultTable, ColumnsAreFoundByTheirHeadings) {
  EXPECT_STREQ(column_headed("truth_error@0.5")->unit, "m");
  EXPECT_EQ(column_headed("truth_error@0.5")->role, Role::error);
  EXPECT_EQ(column_headed("truth_floor@0.5")->role, Role::other);
  for (const char* none : {"truth_error", "sweeps@0.5", "axis", "probe.gamma", ""})
    EXPECT_EQ(column_headed(none), nullptr) << none;
  for (const ResultColumn& column : result_columns()) EXPECT_STREQ(heading_of(column.figure), column.name);
}

} // namespace
} // namespace hopmesh::tests
