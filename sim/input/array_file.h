// Located keys -> an array, checked against the rules of rtl_model/spec.
#pragma once

#include "rtl_model/spec/array_keys.h"
#include "sim/input/toml_source.h"

namespace hopmesh::input {

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
