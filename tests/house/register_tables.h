// The tables of docs/hardware/registers.md, printed from firmware/registers.h.
#pragma once

#include <string>

namespace hopmesh::tests {

inline constexpr const char* registers_page = "docs/hardware/registers.md";

/// The page with what stands between its <!-- table NAME --> and <!-- end --> lines printed afresh.
std::string with_tables(const std::string& page);

} // namespace hopmesh::tests
