#include "sim/machine/rtl/rtl_parameters.h"

#include "rtl_model/spec/capabilities.h"
#include "rtl_model/spec/cycles.h"

namespace hopmesh::machine {

using spec::ArraySpec;
using spec::Topology;

int index_bits(std::size_t many) {
  int bits = 1;
  while ((std::size_t{1} << bits) < many) ++bits;
  return bits;
}

RtlRoom rtl_room(const ArraySpec& a, const Topology& t) {
  RtlRoom room;
  room.taps = t.most_taps();
  room.neurons = t.neurons();
  room.weights = t.weight_words();
  room.cells = t.cells();
  room.links = t.link_to.size();
  room.lines = room.rounds = 0;
  for (const spec::Rounds& rounds : spec::fold_of(a, t, spec::phases_of(t, a.schedule)).rounds)
    for (const spec::Round& round : rounds) {
      room.rounds += 1;
      room.lines += round.accumulate;
    }
  room.places = spec::shares_stage(a) ? room.neurons : room.rounds;
  return room;
}

RtlRoom usual_room(const ArraySpec& a, const RtlRoom& least) {
  const auto up = [](std::size_t usual, std::size_t n) {
    while (usual < n) usual *= 2;
    return usual;
  };
  // About what the flag of 400 nodes takes.
  const std::size_t neurons = up(2048, least.neurons), weights = up(32768, least.weights);
  const std::size_t elements = static_cast<std::size_t>(std::max(a.elements, 1));
  return {up(256, least.taps),
          up(4096, std::max(least.lines, weights / elements)),
          up(2048, least.rounds),
          up(2048, least.places),
          neurons,
          weights,
          up(1024, least.cells),
          up(4096, least.links)};
}

std::vector<RtlParameter> rtl_parameters(const ArraySpec& a, const RtlRoom& room) {
  const spec::Formats f = spec::built_formats(a, room.taps);
  const auto word = [](auto value) { return static_cast<std::uint64_t>(value); };
  const auto bits = [&](const spec::NumberFormat& x) { return word(x.width); };
  const auto fraction = [&](const spec::NumberFormat& x) { return word(x.fraction_bits()); };
  const auto mode = [&](const spec::NumberFormat& x) { return word(x.rounding); };
  return {{"ELEMENTS", word(a.elements)},
          {"SHARED", word(spec::shares_stage(a))},
          {"OUTPUT", word(a.output)},
          {"NORMALISER", word(a.normaliser)},
          {"PIPELINE", word(a.pipeline)},
          {"SYNCHRONOUS", word(a.schedule == spec::Schedule::synchronous)},
          {"WEIGHT_BITS", bits(f.weight)},
          {"WEIGHT_FRACTION", fraction(f.weight)},
          {"BIAS_BITS", bits(f.bias)},
          {"BIAS_FRACTION", fraction(f.bias)},
          {"SUM_BITS", bits(f.accumulator)},
          {"SUM_FRACTION", fraction(f.accumulator)},
          {"DRIVE_BITS", bits(f.drive)},
          {"DRIVE_FRACTION", fraction(f.drive)},
          {"DRIVE_MODE", mode(f.drive)},
          {"DRIVE_OVERFLOW", word(f.drive.overflow)},
          {"STATE_BITS", bits(f.state)},
          {"STATE_FRACTION", fraction(f.state)},
          {"STATE_MODE", mode(f.state)},
          {"LINK_BITS", bits(f.link)},
          {"LINK_FRACTION", fraction(f.link)},
          {"LINK_MODE", mode(f.link)},
          {"MANTISSA", word(a.reciprocal_bits)},
          {"RELAXATION", word(a.relaxation)},
          {"ENTRIES", word(a.momentum_entries)},
          {"LINES", word(room.lines)},
          {"ROUNDS", word(room.rounds)},
          {"PLACES", word(room.places)},
          {"NEURONS", word(room.neurons)},
          {"WEIGHTS", word(room.weights)},
          {"CELLS", word(room.cells)},
          {"LINKS", word(std::max<std::size_t>(room.links, 1))}};
}

std::vector<std::uint32_t> rtl_facts(const ArraySpec& a, const Topology& t) {
  const spec::Phases phases = spec::phases_of(t, a.schedule);
  const auto capabilities = spec::capability_words(a, t, phases.size());
  std::vector<std::uint32_t> facts(capabilities.size());
  for (const auto& [offset, word] : capabilities) facts[(offset - HM_REG_CAP_CELLS) / 4] = word;
  const spec::MemoryMap map = spec::memory_map(a, t);
  for (const spec::MemoryWindow& window : map.window)
    facts.push_back(static_cast<std::uint32_t>(window.words()));
  for (const spec::MemoryWindow& window : map.window) {
    std::uint64_t size = 4;
    while (size < 4 * window.words()) size *= 2;
    facts.push_back(static_cast<std::uint32_t>(size - 1));
  }
  facts.push_back(static_cast<std::uint32_t>(spec::reset_cycles(a, t)));
  facts.push_back(static_cast<std::uint32_t>(rtl_room(a, t).places - 1));
  facts.push_back(static_cast<std::uint32_t>(a.momentum_entries - 1));
  return facts;
}

} // namespace hopmesh::machine
