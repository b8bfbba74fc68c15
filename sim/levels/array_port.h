// The place of an array, whatever it is made of: the firmware sees its bus, a run its figures. Levels plug in
// here.
#pragma once

#include "firmware/host_bus.h"
#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/relaxation.h"
#include "rtl_model/spec/topology.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hopmesh::levels {

/// Words that a host sends or takes at once.
inline constexpr std::size_t longest_burst = 4096;

/// Least and largest raw code that a signal took, and the format it has.
struct SignalRange {
  std::string signal;
  spec::NumberFormat format;
  std::int64_t least = 0, largest = 0;
};

/// Of s and u, which no bus shows.
inline std::vector<SignalRange> inner_ranges(const spec::ArraySpec& array, const spec::Topology& topology,
                                             const spec::Extremes& e) {
  const spec::Formats built = spec::built_formats(array, topology.most_taps());
  return {{"accumulator", built.accumulator, e.least_sum, e.largest_sum},
          {"drive", built.drive, e.least_drive, e.largest_drive}};
}

class ArrayPort : public HostBus {
 public:
  /// Called around each step with its number, for waves.
  virtual void begin_step(std::uint64_t) {}
  virtual void end_step(std::uint64_t) {}
  /// After the last step: what is still being written is ended.
  virtual void finish() {}
  /// Signals that no bus shows: s and u.
  virtual std::vector<SignalRange> inner_ranges() const { return {}; }
  /// What went wrong without touching the results, in one line: a wave that could not be written.
  virtual std::string trouble() const { return {}; }
};

} // namespace hopmesh::levels
