// Names end up in JSON, XML and TOML, which are UTF-8: what is none is refused where it comes in.
#pragma once

#include <string>
#include <string_view>

namespace hopmesh::input {

/// As Unicode has it: no byte out of place, no code in more bytes than it needs, no surrogate.
bool is_utf8(std::string_view text);

/// Throws InputError where `text`, which stood at `place`, is no UTF-8.
void expect_utf8(const std::string& place, const std::string& text);

} // namespace hopmesh::input
