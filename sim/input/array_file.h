// Located keys -> an array, checked against the rules of rtl_model/spec.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "sim/input/toml_source.h"

namespace hopmesh::input {

/// The array that `array` names (a preset, a file, or "" for the default) with overrides of array.* and
/// formats.*.
spec::ArraySpec read_array(const std::string& array,
                           const std::vector<std::pair<std::string, std::string>>& overrides);

/// The array whose text stands in `file`.
spec::ArraySpec array_of(const TomlSource& source, const std::string& file);

} // namespace hopmesh::input
