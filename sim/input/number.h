// The way from text to numbers.
#pragma once

#include <cstdint>
#include <string_view>

namespace hopmesh::input {

/// The number that the whole text is. False, and `value` as it was, where the text is none or its number does
/// not fit.
bool parse_number(std::string_view text, std::uint64_t& value, int base = 10);
bool parse_number(std::string_view text, std::int64_t& value);
/// A real number may begin with a plus; what is too small for a double is 0.
bool parse_number(std::string_view text, double& value);

/// A real number as Fortran writes it too: 1.5D-3.
bool parse_real(std::string_view text, double& value);

} // namespace hopmesh::input
