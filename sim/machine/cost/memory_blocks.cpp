#include "sim/machine/cost/memory_blocks.h"

#include "sim/machine/cost/cost_model.h"
#include "sim/machine/rtl/rtl_parameters.h"
#include "sim/machine/silicon.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hopmesh::machine {

namespace {

struct Shape {
  std::uint64_t width, depth;
};
constexpr std::array<Shape, 6> ecp5_shapes{
    {{36, 512}, {18, 1024}, {9, 2048}, {4, 4096}, {2, 8192}, {1, 16384}}};
constexpr std::array<Shape, 4> ice40_shapes{{{16, 256}, {8, 512}, {4, 1024}, {2, 2048}}};
constexpr std::uint64_t least_ecp5 = 512; ///< bits: below, an FPGA takes LUTs

template <typename Shapes> double fewest(const Shapes& shapes, const MemoryShape& memory) {
  double best = std::numeric_limits<double>::infinity();
  for (const Shape& s : shapes) {
    const std::uint64_t wide = (memory.width + s.width - 1) / s.width;
    const std::uint64_t deep = (memory.depth + s.depth - 1) / s.depth;
    best = std::min(best, static_cast<double>(wide * deep));
  }
  return best;
}

std::uint64_t wide(const spec::NumberFormat& format) {
  return static_cast<std::uint64_t>(format.width);
}

/// What depends on the network and never changes, as rtl_tables makes them; an array without a fold has wires
/// in their place.
void add_tables(const spec::ArraySpec& array, const Parameters& p, std::vector<MemoryShape>& all) {
  if (!spec::is_folded(array)) return;
  const auto room = [&p](const char* name) { return static_cast<std::uint64_t>(p.at(name)); };
  const auto bits = [](std::uint64_t many) { return static_cast<std::uint64_t>(index_bits(many)); };
  const std::uint64_t elements = room("ELEMENTS"), place = bits(room("PLACES"));
  const std::uint64_t memory = spec::shares_stage(array) || elements == 1 ? 0 : bits(elements);
  const std::uint64_t own = array.output == spec::Output::projected ? 1 : 0;
  const std::uint64_t tap = (place + memory + 1 + own) * static_cast<std::uint64_t>(array.lanes);
  all.push_back({"lines", 1, 3 + elements * tap, room("LINES"), true});
  all.push_back({"table", 1, bits(elements + 1) + 2, room("ROUNDS"), true});
  all.push_back({"table", 1, bits(room("LINES")) + bits(elements), room("WEIGHTS"), true});
  all.push_back({"table", 1, place + bits(elements), room("NEURONS"), true});
  all.push_back({"table", 1, bits(room("LINKS") + 1), room("CELLS") + 1, true});
  all.push_back({"table", 1, bits(room("CELLS") + 1), room("LINKS"), true});
}

} // namespace

std::vector<MemoryShape> memories_of(const spec::ArraySpec& array, const spec::Topology& topology) {
  const Parts parts = parts_of(array, topology);
  const spec::Formats& f = array.formats;
  const bool folded = spec::is_folded(array);
  const Parameters p = cost_parameters(array, topology);
  const auto lines = static_cast<std::uint64_t>(p.at("LINES"));
  const auto places = static_cast<std::uint64_t>(p.at("PLACES"));
  const auto elements = static_cast<double>(parts.accumulators), stages = static_cast<double>(parts.stages);
  const std::uint64_t rows = folded ? lines : topology.most_taps(), per_stage = folded ? places : 1;
  std::vector<MemoryShape> all{{"weights", elements, wide(f.weight), rows},
                               {"biases", stages, wide(f.bias), per_stage},
                               {"states", stages * double(parts.points), wide(f.state), per_stage}};
  if (spec::sums_norm(array)) {
    const int kept =
        spec::has_reciprocal(array) ? reciprocal_bits(array, topology) : norm_bits(array, topology);
    all.push_back({"norms", stages, static_cast<std::uint64_t>(kept), per_stage});
  }
  if (folded)
    all.push_back({"links", elements * stages, wide(f.link) * parts.points, places * parts.link_banks});
  if (spec::has_momentum(array))
    all.push_back({"table of m", 1, 16, static_cast<std::uint64_t>(array.momentum_entries)});
  add_tables(array, p, all);
  return all;
}

MemoryBlocks memory_blocks(const std::vector<MemoryShape>& memories) {
  MemoryBlocks blocks;
  for (const MemoryShape& m : memories) {
    (m.read_only ? blocks.table_bits : blocks.bits) += m.bits();
    if (m.width * m.depth < least_ecp5) continue;
    blocks.ecp5_blocks += m.count * fewest(ecp5_shapes, m);
    blocks.ice40_blocks += m.count * fewest(ice40_shapes, m);
  }
  return blocks;
}

} // namespace hopmesh::machine
