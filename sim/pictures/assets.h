// Files that live in the program, so that an installed program needs no data folder for them: the report's
// HTML, CSS and JavaScript, and the picture on every flag.
#pragma once

#include <string>

namespace hopmesh::pictures {

/// The bytes of report/NAME, or of crest.png.
const std::string& asset(const std::string& name);

} // namespace hopmesh::pictures
