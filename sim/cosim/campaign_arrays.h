// The arrays of a campaign that somebody names, and what levels have to make ready for them.
#pragma once

#include "rtl_model/spec/array_spec.h"

#include <string>
#include <vector>

namespace hopmesh::cosim {

/// Presets or files, read; before anything else is made, each level makes ready what takes a while. None:
/// random arrays, which a level that has to make something cannot have. Throws input::InputError; adds to
/// `notes` as input::read_array does.
std::vector<spec::ArraySpec> campaign_arrays(const std::vector<std::string>& level_names,
                                             const std::vector<std::string>& arrays,
                                             std::vector<std::string>& notes);

} // namespace hopmesh::cosim
