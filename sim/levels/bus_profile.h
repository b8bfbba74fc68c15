// Listens on a bus: the range of codes that pass through each window.
#pragma once

#include "sim/levels/array_port.h"

#include <array>

namespace hopmesh::levels {

/// Stands between firmware and array, and passes everything on unchanged.
class BusProfile {
 public:
  BusProfile(const hm_bus& inner, const spec::ArraySpec& array);
  BusProfile(const BusProfile&) = delete;
  BusProfile& operator=(const BusProfile&) = delete;

  const hm_bus& bus() const { return outer_; }
  std::vector<SignalRange> ranges() const { return {ranges_.begin(), ranges_.end()}; }

 private:
  void note(std::uint32_t address, const std::uint32_t* words, std::uint32_t count);

  const hm_bus inner_;
  hm_bus outer_{};
  std::array<SignalRange, 3> ranges_; ///< weight, bias, state
};

} // namespace hopmesh::levels
