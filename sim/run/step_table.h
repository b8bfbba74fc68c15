// steps.csv: rows of a run written, and read back to the same bits.
#pragma once

#include "sim/files/csv.h"
#include "sim/levels/mover.h"
#include "sim/levels/step_columns.h"

#include <functional>

namespace hopmesh::run {

using StepColumns = std::vector<levels::StepColumn>;

/// levels::all_step_columns, for those who are given no other table.
const StepColumns& step_columns();
std::vector<std::string> step_header(const StepColumns& columns = step_columns());

void write_row(files::CsvWriter& table, const levels::StepRow& row,
               const StepColumns& columns = step_columns());

/// The rows in the first `bytes` of a table, one after the other. Throws input::InputError with file and line
/// where they are none.
void each_row(const std::filesystem::path& table, std::uint64_t bytes, const StepColumns& columns,
              const std::function<void(const levels::StepRow&)>& use);
std::vector<levels::StepRow> read_rows(const std::filesystem::path& table, std::uint64_t bytes,
                                       const StepColumns& columns = step_columns());

} // namespace hopmesh::run
