// steps.csv: rows of a run written, and read back to the same bits.
#pragma once

#include "sim/files/csv.h"
#include "sim/levels/motion.h"

namespace hopmesh::run {

/// In the order of the file.
const std::vector<std::string>& step_columns();

void write_row(files::CsvWriter& table, const levels::StepRow& row);

/// The rows in the first `bytes` of a table. Throws scene::InputError with file and line where they are none.
std::vector<levels::StepRow> read_rows(const std::filesystem::path& table, std::uint64_t bytes);

} // namespace hopmesh::run
