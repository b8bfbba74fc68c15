// Memories as Verilog's $readmemh and $writememh know them.
#pragma once

#include "sim/cosim/firings/firing_columns.h"

namespace hopmesh::cosim {

/// The low `bits` of a code in hexadecimal digits, with zeros in front.
std::string memory_word(std::int64_t code, int bits);
/// A file of at most `cells` words of so many bits: comments, addresses behind an at-sign and underscores
/// may stand in it, as the language has them. What no word tells, or tells with x or z, is empty. Throws
/// input::InputError with the line of a mistake.
std::vector<Cell> read_memory(const std::string& path, std::size_t cells, int bits, bool negative);

} // namespace hopmesh::cosim
