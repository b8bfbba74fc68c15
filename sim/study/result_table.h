// results.csv: the rows of a study's points written, and its columns found again by name.
#pragma once

#include "sim/files/csv.h"
#include "sim/study/point_row.h"
#include "sim/study/study_file.h"

namespace hopmesh::study {

using ResultColumns = std::vector<ResultColumn>;

/// all_result_columns, for those who are given no other table.
const ResultColumns& result_columns();

std::vector<std::string> result_header(const Study& study, const ResultColumns& columns = result_columns());

/// What a crash left open is an empty cell.
void write_result(files::CsvWriter& table, const Study& study, const Point& point, const PointRow& row,
                  const ResultColumns& columns = result_columns());

/// The name of the column that shows a member, as in heading_of(&PointRow::sweeps).
const char* heading_of(const ResultFigure& figure);

/// The column of a heading, "cycles" or "truth_error@0.5"; null where that is an axis of the study.
const ResultColumn* column_headed(std::string_view heading, const ResultColumns& columns = result_columns());

} // namespace hopmesh::study
