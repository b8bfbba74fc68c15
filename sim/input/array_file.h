// Located keys -> an array, checked against the rules of rtl_model/spec.
#pragma once

#include "sim/input/key_table.h"

namespace hopmesh::input {

/// Whether a key, or an override that begins with one, is in a table of array files.
bool is_array_key(const std::string& key);

/// The rows of an array as rows of a file, and those that name and start it. Any number is read; the rules
/// judge it.
Keys array_file_keys(spec::ArraySpec& array, spec::ArrayTable table = spec::array_keys);

/// The array that `array` names (a preset, a file, or "" for the default) with overrides of array.* and
/// formats.*. Adds a line to `notes` for each key that was set and has no effect.
spec::ArraySpec read_array(const std::string& array,
                           const std::vector<std::pair<std::string, std::string>>& overrides,
                           std::vector<std::string>& notes);

/// The array whose text stands in `file`.
spec::ArraySpec array_of(const TomlSource& source, const std::string& file,
                         spec::ArrayTable table = spec::array_keys);

/// The whole array with every default filled in, as a file.
std::string array_text(spec::ArraySpec array, spec::ArrayTable table = spec::array_keys);

} // namespace hopmesh::input
