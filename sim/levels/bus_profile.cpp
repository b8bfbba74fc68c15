#include "sim/levels/bus_profile.h"

#include "firmware/registers.h"

#include <algorithm>

namespace hopmesh::levels {

BusProfile::BusProfile(HostBus& inner, const spec::ArraySpec& array)
    : inner_(inner), ranges_{SignalRange{"weight", array.formats.weight},
                             SignalRange{"bias", array.formats.bias},
                             SignalRange{"state", array.formats.state}} {}

int BusProfile::read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
  const int error = inner_.read(address, words, count);
  if (error == HM_OK) note(address, words, count);
  return error;
}

int BusProfile::write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  note(address, words, count);
  return inner_.write(address, words, count);
}

void BusProfile::note(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
  SignalRange* range = address >= HM_WINDOW_WEIGHT   ? &ranges_[0]
                       : address >= HM_WINDOW_OUTPUT ? &ranges_[2]
                       : address >= HM_WINDOW_BIAS   ? &ranges_[1]
                                                     : nullptr;
  if (!range) return;
  std::int32_t least = 0,
               largest = 0; // zero is always in the range; in words, several are compared at a time
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto code = static_cast<std::int32_t>(words[k]);
    least = std::min(least, code);
    largest = std::max(largest, code);
  }
  range->least = std::min<std::int64_t>(range->least, least);
  range->largest = std::max<std::int64_t>(range->largest, largest);
}

} // namespace hopmesh::levels
