// A design placed and routed on an iCE40 by nextpnr: does it fit, and how fast is its clock?
#pragma once

#include "sim/machine/cost/tool_run.h"

namespace hopmesh::machine {

struct Placement {
  std::string device; ///< "up5k", "hx8k"
  bool fits = false;
  std::string why;          ///< it does not
  std::vector<double> mhz;  ///< of each seed that was routed
  double cells = 0, of = 0; ///< logic cells, with those of the harness
  double memories = 0, multipliers = 0;
  bool without_dsp = false;
};

/// `design`: a folder that hopmesh rtl wrote. Pins of the device are fewer than ports of the design:
/// registers of a harness stand between, about 250 logic cells. Tries so many seeds, and the smaller device
/// first.
Placement place_on_ice40(const std::filesystem::path& design, const CostTools& tools, int seeds,
                         std::size_t workers, const std::function<void(const std::string&)>& tell);

} // namespace hopmesh::machine
