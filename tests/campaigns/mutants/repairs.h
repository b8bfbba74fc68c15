// Checks of a mutant made right again: what stands behind them is read by nobody else.
#pragma once

#include <string>

namespace hopmesh::campaigns {

/// The CRC of each chunk of a PNG file, as far as chunks can be told.
void repair_png(std::string& bytes);
/// The check at the end of each row of a table that this program keeps.
void repair_rows(std::string& bytes);
/// The check of each line of a checkpoint, up to the values.
void repair_checkpoint(std::string& bytes);

} // namespace hopmesh::campaigns
