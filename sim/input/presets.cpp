#include "sim/input/presets.h"

#include "rtl_model/spec/presets.h"

#include <fmt/format.h>

namespace hopmesh::input {

std::vector<PresetWords> preset_words() {
  std::vector<PresetWords> presets;
  for (const spec::ArraySpec& array : spec::presets())
    presets.push_back(
        {array.name,
         fmt::format("{}, {}, {} lane{}, states of {} bits, links of {}", spec::name_of(array.schedule),
                     spec::name_of(array.normaliser), array.lanes, array.lanes == 1 ? "" : "s",
                     array.formats.state.width, array.formats.link.width),
         array.name == spec::default_array().name});
  return presets;
}

} // namespace hopmesh::input
