// Files that long work keeps and believes later: what is not as it was written is set aside and made again,
// and nobody computes with it.
#pragma once

#include "sim/files/csv_table.h"
#include "sim/input/input_error.h"

namespace hopmesh::files {

/// A kept file is damaged, and has been set aside: the same command makes it again.
class DamagedFile : public input::InputError {
 public:
  using input::InputError::InputError;
};

/// Moves the file to NAME.damaged; `why` is the sentence that says what is wrong, with its place.
DamagedFile set_aside(const std::filesystem::path& file, const std::string& why);

/// A table that CsvWriter wrote with CheckedRows. Throws DamagedFile.
CsvTable read_kept(const std::filesystem::path& file, const std::vector<std::string>& columns);

} // namespace hopmesh::files
