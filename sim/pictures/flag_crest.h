// The crest on every flag as a PNG file, 512 wide: drawn when the program is built, so that no run waits for
// it.
#pragma once

#include <string_view>

namespace hopmesh::pictures {

/// What crest_png(512) of crest.h gives.
std::string_view flag_crest();

} // namespace hopmesh::pictures
