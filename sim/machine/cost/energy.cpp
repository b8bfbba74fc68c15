#include "sim/machine/cost/energy.h"

#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/memory_map.h"
#include "sim/machine/cost/cost_model.h"
#include "sim/machine/silicon.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::machine {

namespace {

constexpr double pico = 1e-12;

// M. Horowitz, ISSCC 2014, 45 nm and 0.9 V: an addition of 32 bits takes 0.1 pJ, a multiplication of 32 by 32
// bits 3.1 pJ, and reading 64 bits of a memory of 8 KiB 10 pJ. Between, an addition goes with its bits, a
// multiplication with the product of its widths (8 by 8 bits: 0.19 where the table says 0.2), a memory with
// the root of its size (32 KiB: 20, as the table says; 1 MiB: 113 where it says 100).
constexpr double add_pj = 0.1 / 32, multiply_pj = 3.1 / (32 * 32), access_64_pj = 10, table_bits = 8 * 8192;
// A wire of the bus: as a bit of a memory of 8 KiB. An estimate of ours.
constexpr double bus_bit_pj = access_64_pj / 64;
// Capacities go with the size of transistors, energies with the voltage's square, too.
constexpr double to_osu018 = (180.0 / 45) * (1.8 / 0.9) * (1.8 / 0.9);
// No memory is cheaper per bit than a register file of so many bits.
constexpr double least_bits = 1024;

double access_pj(const MemoryShape& memory) {
  const double size = std::max(least_bits, static_cast<double>(memory.width * memory.depth));
  return access_64_pj / 64 * static_cast<double>(memory.width) * std::sqrt(size / table_bits);
}

/// How often each memory is read and written.
struct Accesses {
  double reads = 0, writes = 0;
};
Accesses accesses_of(const MemoryShape& m, const Activity& a, const Parts& parts, const Work& work,
                     double lines) {
  const std::string what = m.what;
  const auto sweeps = static_cast<double>(work.sweeps);
  if (what == "weights") return {a.products, a.bus_words};
  if (what == "links") return {a.products, a.firings * static_cast<double>(parts.link_memories)};
  if (what == "states") return {a.firings * double(parts.points), a.firings * double(parts.points)};
  if (what == "table of m") return {sweeps, 0};
  if (what == "lines") return {sweeps * lines, 0};
  if (what == "table")
    return {}; // but for rounds, of which there are few, read by the host's transfers alone
  return {a.firings, 0};
}

} // namespace

Activity activity_of(const spec::ArraySpec& array, const spec::Topology& topology, const Work& work,
                     std::uint64_t runs) {
  const Parts parts = parts_of(array, topology);
  const auto sweeps = static_cast<double>(work.sweeps),
             prepared = spec::sums_norm(array) ? double(runs) : 0.0;
  const auto weights = static_cast<double>(topology.weight_words());
  const auto neurons = static_cast<double>(topology.neurons());
  Activity a;
  a.products = (sweeps + prepared) * weights;
  a.firings = (sweeps + prepared) * neurons;
  a.cycles = static_cast<double>(work.array_cycles);
  a.all_cycles = a.cycles + static_cast<double>(work.bus_cycles);
  a.bus_words = static_cast<double>(work.bus_cycles);
  const double lines = static_cast<double>(cost_parameters(array, topology).at("LINES"));
  for (const MemoryShape& m : memories_of(array, topology)) {
    const Accesses n = accesses_of(m, a, parts, work, lines);
    const auto width = static_cast<double>(m.width);
    (m.read_only ? a.table_bits : a.read_bits) += n.reads * width;
    a.written_bits += n.writes * width;
    a.access_pj += (n.reads + n.writes) * access_pj(m);
  }
  return a;
}

Energy silicon_energy(const Activity& a, const CostPoint& parts, const Toggles& toggles) {
  const auto of = [&](Part part, Figure figure) {
    return figure_of(parts.parts[static_cast<std::size_t>(part)], figure);
  };
  Energy e;
  for (const Part part : {Part::element, Part::stage, Part::rest})
    e.clock += a.all_cycles * count_of(part, parts.parameters) * of(part, Figure::idle_pj) * pico;
  // Parts were weighed with a quarter of the bits changing.
  const double inputs = (toggles.weights + toggles.links) / 2 / 0.25;
  e.arithmetic = a.products * of(Part::element, Figure::active_pj) * inputs * pico +
                 a.firings * of(Part::stage, Figure::active_pj) * 0.5 / 0.25 * pico +
                 a.all_cycles * of(Part::rest, Figure::active_pj) * pico;
  e.memory = a.access_pj * to_osu018 * pico;
  e.bus = a.bus_words * 32 * bus_bit_pj * to_osu018 * pico;
  return e;
}

Energy table_energy(const Activity& a, const Parameters& p) {
  const std::vector<double> element = features_of(Part::element, p), stage = features_of(Part::stage, p);
  Energy e;
  e.arithmetic = a.products * (element[1] * multiply_pj + element[2] * add_pj) * pico +
                 a.firings * (stage[2] * multiply_pj + (stage[3] + stage[4]) * add_pj) * pico;
  e.memory = a.access_pj * pico;
  e.bus = a.bus_words * 32 * bus_bit_pj * pico;
  return e;
}

} // namespace hopmesh::machine
