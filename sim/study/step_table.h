// steps.csv: rows of a run written, and read back to the same bits.
#pragma once

#include "sim/record/csv.h"
#include "sim/study/motion.h"

namespace hopmesh::study {

/// In the order of the file.
const std::vector<std::string>& step_columns();

void write_row(record::CsvWriter& table, const StepRow& row);

/// The rows in the first `bytes` of a table. Throws scene::InputError with file and line where they are none.
std::vector<StepRow> read_rows(const std::filesystem::path& table, std::uint64_t bytes);

} // namespace hopmesh::study
