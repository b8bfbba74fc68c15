#include "sim/levels/bus_profile.h"

#include "firmware/registers.h"

#include <algorithm>

namespace hopmesh::levels {

BusProfile::BusProfile(const hm_bus& inner, const spec::ArraySpec& array)
    : inner_(inner), ranges_{SignalRange{"weight", array.formats.weight},
                             SignalRange{"bias", array.formats.bias},
                             SignalRange{"state", array.formats.state}} {
  outer_.context = this;
  outer_.read = [](void* c, std::uint32_t address, std::uint32_t* word) {
    auto* me = static_cast<BusProfile*>(c);
    return me->inner_.read(me->inner_.context, address, word);
  };
  outer_.write = [](void* c, std::uint32_t address, std::uint32_t word) {
    auto* me = static_cast<BusProfile*>(c);
    return me->inner_.write(me->inner_.context, address, word);
  };
  outer_.read_burst = [](void* c, std::uint32_t address, std::uint32_t* words, std::uint32_t count) {
    auto* me = static_cast<BusProfile*>(c);
    const int error = me->inner_.read_burst(me->inner_.context, address, words, count);
    if (error == HM_OK) me->note(address, words, count);
    return error;
  };
  outer_.write_burst = [](void* c, std::uint32_t address, const std::uint32_t* words, std::uint32_t count) {
    auto* me = static_cast<BusProfile*>(c);
    me->note(address, words, count);
    return me->inner_.write_burst(me->inner_.context, address, words, count);
  };
  outer_.wait = [](void* c) {
    auto* me = static_cast<BusProfile*>(c);
    return me->inner_.wait(me->inner_.context);
  };
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
