// What a host finds behind the registers: where each window lies on the bus, and how codes share its words
// (docs/hardware/registers.md).
#pragma once

#include "firmware/registers.h"
#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::spec {

/// The windows of firmware/registers.h, in the order of their table.
#define HM_X(name, access, meaning) name,
enum class Window : std::uint8_t { HM_WINDOWS(HM_X) };
#undef HM_X
#define HM_X(name, access, meaning) Window::name,
inline constexpr Window windows[] = {HM_WINDOWS(HM_X)};
#undef HM_X
inline constexpr std::size_t window_count = std::size(windows);

/// Whether a host may write to the window.
inline bool is_writable(Window w) {
  enum class Access { RO, RW };
#define HM_X(name, access, meaning) Access::access == Access::RW,
  static constexpr bool writable[] = {HM_WINDOWS(HM_X)};
#undef HM_X
  return writable[static_cast<std::size_t>(w)];
}

/// A window as built. Code k lies in word k / codes_a_word, from the low end on.
struct MemoryWindow {
  std::uint64_t codes = 0;
  int codes_a_word = 1;     ///< 1, 2 or 4
  std::uint64_t offset = 0; ///< bytes; 0: it has no words, and lies nowhere

  std::uint64_t words() const {
    const auto n = static_cast<std::uint64_t>(codes_a_word);
    return (codes + n - 1) / n;
  }
  int code_bits() const { return 32 / codes_a_word; }
  bool holds(std::uint64_t address) const {
    return words() > 0 && address >= offset && address - offset < 4 * words();
  }
};

struct MemoryMap {
  std::array<MemoryWindow, window_count> window;
  std::uint64_t span = 0; ///< bytes that hold it all, a power of two

  const MemoryWindow& operator[](Window w) const { return window[static_cast<std::size_t>(w)]; }
};

/// What 32 address bits reach.
inline constexpr std::uint64_t most_span = std::uint64_t{1} << 32;

/// Codes of this format that a word takes; more than one only where each has its half, or quarter, of it.
inline int codes_a_word(const ArraySpec& a, const NumberFormat& f) {
  if (!a.packing) return 1;
  return f.width <= 8 ? 4 : f.width <= 16 ? 2 : 1;
}

/// Is there a window that packing makes shorter?
inline bool can_pack(ArraySpec a) {
  a.packing = true;
  const Formats& f = a.formats;
  return codes_a_word(a, f.weight) > 1 || codes_a_word(a, f.bias) > 1 || codes_a_word(a, f.state) > 1 ||
         has_momentum(a);
}

namespace detail {

inline std::uint64_t power_of_two_from(std::uint64_t least) {
  std::uint64_t power = 4;
  while (power < least) power *= 2;
  return power;
}

/// A window as memory_map() begins it: its offset is not set yet.
inline MemoryWindow window_of(Window w, const ArraySpec& a, const Topology& t) {
  switch (w) {
  case Window::FIRST_LINK:
    return {t.first_link.size()};
  case Window::LINK:
    return {t.link_to.size()};
  case Window::BIAS:
    return {t.neurons(), codes_a_word(a, a.formats.bias)};
  case Window::OUTPUT:
    return {t.neurons(), codes_a_word(a, a.formats.state)};
  case Window::WEIGHT:
    return {t.weight_words(), codes_a_word(a, a.formats.weight)};
  case Window::MOMENTUM:
    if (!has_momentum(a)) return {};
    return {static_cast<std::uint64_t>(a.momentum_entries), codes_a_word(a, momentum_format)};
  }
  return {};
}

} // namespace detail

/// Each window takes the next power of two of its bytes and lies at the next multiple of that, behind the one
/// before; the first behind the registers. A window of no words takes no room.
inline MemoryMap memory_map(const ArraySpec& a, const Topology& t) {
  MemoryMap map;
  std::uint64_t end = HM_REGISTER_BYTES;
  for (std::size_t k = 0; k < window_count; ++k) {
    MemoryWindow& window = map.window[k] = detail::window_of(static_cast<Window>(k), a, t);
    if (window.words() == 0) continue;
    const std::uint64_t size = detail::power_of_two_from(4 * window.words());
    window.offset = (end + size - 1) / size * size;
    end = window.offset + size;
  }
  map.span = detail::power_of_two_from(end);
  return map;
}

/// An answer that refuses a transfer holds the bus for its address and one beat.
inline constexpr std::uint64_t error_cycles = 2;

} // namespace hopmesh::spec
