#include "sim/levels/bus_profile.h"

#include "sim/levels/codes.h"

#include <algorithm>

namespace hopmesh::levels {

BusProfile::BusProfile(HostBus& inner, const spec::ArraySpec& array, const spec::Topology& topology)
    : inner_(inner),
      map_(spec::memory_map(array, topology)), ranges_{SignalRange{"weight", array.formats.weight},
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
  using spec::Window;
  constexpr std::array<Window, 3> watched{Window::WEIGHT, Window::BIAS, Window::OUTPUT};
  const auto at =
      std::find_if(watched.begin(), watched.end(), [&](Window w) { return map_[w].holds(address); });
  if (at == watched.end()) return;
  const int n = map_[*at].codes_a_word;
  std::int32_t least = 0,
               largest = 0; // zero is always in the range; in words, several are compared at a time
  const auto see = [&](std::int32_t code) {
    least = std::min(least, code);
    largest = std::max(largest, code);
  };
  if (n == 1)
    for (std::uint32_t k = 0; k < count; ++k) see(static_cast<std::int32_t>(words[k]));
  else // behind the last code stand zeros
    for (std::size_t k = 0; k < count * static_cast<std::size_t>(n); ++k) see(code_in(words, n, k));
  SignalRange& range = ranges_[static_cast<std::size_t>(at - watched.begin())];
  range.least = std::min<std::int64_t>(range.least, least);
  range.largest = std::max<std::int64_t>(range.largest, largest);
}

} // namespace hopmesh::levels
