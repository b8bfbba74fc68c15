// [host] of a scene file: what runs the firmware beside an array. Values, and a row for each key.
#pragma once

#include "sim/input/key_table.h"
#include "sim/scene/limits.h"

namespace hopmesh::scene {

enum class Processor : std::uint8_t { native, rv32 };
inline constexpr std::array<std::string_view, 2> processor_names{"native", "rv32"};

enum class Core : std::uint8_t { rv32im, rv32imfd };
inline constexpr std::array<std::string_view, 2> core_names{"rv32im", "rv32imfd"};

inline std::string name_of(Core core) {
  return std::string(core_names[static_cast<std::size_t>(core)]);
}

enum class Arithmetic : std::uint8_t { doubles, fixed };
inline constexpr std::array<std::string_view, 2> arithmetic_names{"double", "fixed"};

struct HostSpec {
  Processor processor = Processor::native;
  Core core = Core::rv32im;
  Arithmetic arithmetic = Arithmetic::doubles;
  bool dma = true;
  double cpi = 1, clock_mhz = 100;

  /// Instructions are counted, so that their time is known.
  bool counts() const { return processor == Processor::rv32; }
  /// None where nobody counts them.
  std::optional<double> known_seconds(double instructions) const {
    if (!counts()) return std::nullopt;
    return instructions * cpi / (clock_mhz * 1e6);
  }
};

inline input::Keys host_keys(HostSpec& h) {
  using namespace input;
  const When counted{h.counts(), "host.processor = \"rv32\""};
  return {
      Key("host.processor", spec::choice(h.processor, processor_names),
          "what runs the firmware beside an array: this very processor, or an emulated 32-bit RISC-V core "
          "whose instructions are counted"),
      Key("host.core", spec::choice(h.core, core_names),
          "without floating point, which is then a library's, or with an FPU for doubles")
          .counts(counted),
      Key("host.arithmetic", spec::choice(h.arithmetic, arithmetic_names),
          "in which a step makes its network and moves its nodes: doubles, or whole numbers alone"),
      Key("host.dma", &h.dma,
          "a bus master moves whole bursts; false: the host's own loop moves word by word, each a transfer "
          "of "
          "its own"),
      Key("host.cpi", &h.cpi, {0.01, 1000, "a number from 0.01 to 1000"},
          "cycles that an instruction takes on average")
          .counts(counted),
      Key("host.clock_mhz", &h.clock_mhz, {0.001, 100000, "a number from 0.001 to 100000"}, "of that core")
          .in_unit("MHz")
          .counts(counted),
  };
}

} // namespace hopmesh::scene
