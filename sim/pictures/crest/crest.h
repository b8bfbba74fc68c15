// The flag's own picture: a golden shield with a mesh of hops on deep blue cloth, drawn from formulas. Drawn
// once, when the program is built (flag_crest.h holds the result).
#pragma once

#include "sim/files/png.h"

namespace hopmesh::pictures {

/// The same bytes at every call. The picture is square: it is stretched over flags of other shapes.
files::Picture draw_crest(std::uint32_t size);

/// The crest as PNG.
std::string crest_png(std::uint32_t size);

} // namespace hopmesh::pictures
