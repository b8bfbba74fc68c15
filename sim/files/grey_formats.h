// The formats that read_grey knows, each with a source of its own.
#pragma once

#include "sim/files/grey_picture.h"

namespace hopmesh::files {

GreyPicture read_pgm(std::string_view bytes);
GreyPicture read_png(std::string_view bytes, double ground);

/// Refuses a picture without pixels, and one larger than anybody means.
void check_size(std::uint32_t width, std::uint32_t height);

} // namespace hopmesh::files
