#include "sim/cosim/campaign_arrays.h"

#include "sim/input/array_file.h"
#include "sim/input/input_error.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

std::vector<spec::ArraySpec> campaign_arrays(const std::vector<std::string>& names,
                                             const std::vector<std::string>& arrays,
                                             std::vector<std::string>& notes) {
  std::vector<spec::ArraySpec> read;
  for (const std::string& array : arrays) read.push_back(input::read_array(array, {}, notes));
  for (const std::string& name : names) {
    const levels::Level& level = levels::level_named(name, "--levels", {levels::Kind::array});
    if (!level.make_ready) continue;
    if (read.empty())
      throw input::input_error("", 0, "--arrays", "none", "the arrays of a campaign with level " + name);
    for (const spec::ArraySpec& array : read) level.make_ready(array);
  }
  return read;
}

} // namespace hopmesh::cosim
