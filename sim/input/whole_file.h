// A whole file as text; everything that is no readable file is refused in one line.
#pragma once

#include <string>

namespace hopmesh::input {

/// The bytes of the file. `kind` says in messages what it should have been, e.g. "a scene file".
/// Throws InputError for a missing file, a directory, an empty one, or one of more than `most_bytes`.
std::string read_whole_file(const std::string& path, const std::string& kind, std::size_t most_bytes);

} // namespace hopmesh::input
