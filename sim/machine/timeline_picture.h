// Who works when, drawn: the lanes of a step, and the shares of a whole motion.
#pragma once

#include "sim/machine/timeline.h"

#include <string>

namespace hopmesh::machine {

struct TimelineView {
  std::string title, note;
  std::string step_name; ///< which step the lanes show
  std::uint64_t runs = 1;
  std::uint64_t read = 0; ///< of the step's cycles of the bus, those after its runs
  Timeline step;
  std::string motion_name; ///< what the shares are of
  Timeline motion;
  double clock_mhz = 100;
};

std::string svg_of(const TimelineView& view);

} // namespace hopmesh::machine
