// Tables that several processes of a study need and one of them works out: the others wait for it.
#pragma once

#include "sim/files/csv.h"
#include "sim/files/kept_file.h"

namespace hopmesh::study {

/// The right to work a table out, as a writer of checked rows that nobody else can begin; none where somebody
/// else did, and has finished it or the user wants to stop. What a killed process began is taken over.
std::optional<files::CsvWriter> claim_table(const std::filesystem::path& table,
                                            const std::vector<std::string>& columns);

/// A cell of a kept table is not what it must be: sets the table aside. `row`: from 0, behind the header.
files::DamagedFile damaged_cell(const std::filesystem::path& table, std::size_t row, const std::string& key,
                                const std::string& found, const std::string& expected);

} // namespace hopmesh::study
