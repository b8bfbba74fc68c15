// Random meshes, arrays and codes.
#include "sim/cosim/random_job.h"

#include "rtl_model/spec/array_keys.h"
#include "rtl_model/spec/array_rules.h"

#include <cmath>
#include <set>

namespace hopmesh::cosim {
namespace {

spec::NumberFormat random_format(Dice& dice, int least_integer_bits) {
  spec::NumberFormat f;
  f.width = static_cast<int>(dice.between(spec::least_width, dice.one_in(2) ? 16 : spec::most_width));
  const int most = dice.one_in(3) ? f.width - 1 : std::min(f.width - 1, least_integer_bits + 2);
  f.integer_bits = static_cast<int>(dice.between(least_integer_bits, most));
  f.rounding = dice.mode<spec::Rounding>(spec::rounding_names);
  f.overflow = dice.mode<spec::Overflow>(spec::overflow_names);
  return f;
}

Edges random_edges(Dice& dice, std::size_t cells) {
  Edges edges;
  const bool tree = dice.one_in(2);
  for (std::uint32_t c = 1; c < cells && tree; ++c)
    edges.push_back({static_cast<std::uint32_t>(dice.below(c)), c});
  const std::uint64_t more = dice.below(2 * cells + 1);
  for (std::uint64_t k = 0; k < more && cells > 1; ++k) {
    const auto a = static_cast<std::uint32_t>(dice.below(cells)),
               b = static_cast<std::uint32_t>(dice.below(cells));
    if (a != b) edges.push_back({a, b});
  }
  return edges;
}

Edges star_edges(std::size_t cells) {
  Edges edges;
  for (std::uint32_t c = 1; c < cells; ++c) edges.push_back({0, c});
  return edges;
}

Edges all_edges(std::size_t cells) {
  Edges edges;
  for (std::uint32_t a = 0; a < cells; ++a)
    for (std::uint32_t b = 0; b < a; ++b) edges.push_back({b, a});
  return edges;
}

/// A row or vector in one of several characters: anything, nothing, all at one end, all of one sign.
void fill(Dice& dice, const spec::NumberFormat& format, std::int32_t* first, std::size_t count) {
  const std::uint64_t character = dice.below(8);
  for (std::size_t k = 0; k < count; ++k) {
    std::int64_t code = dice.code(format);
    if (character == 0) code = 0;
    if (character == 1) code = format.max_raw();
    if (character == 2) code = format.min_raw();
    if (character == 3) code = dice.between(0, format.max_raw());
    first[k] = static_cast<std::int32_t>(code);
  }
}

} // namespace

std::int64_t Dice::code(const spec::NumberFormat& format) {
  switch (below(8)) {
  case 0:
    return 0;
  case 1:
    return one_in(2) ? format.max_raw() : format.min_raw();
  case 2:
    return one_in(2) ? 1 : -1;
  case 3:
    return (one_in(2) ? 1 : -1) * (std::int64_t{1} << below(format.width - 1));
  default:
    return between(format.min_raw(), format.max_raw());
  }
}

spec::Topology topology_of(std::size_t cells, int neurons_per_cell, const Edges& edges) {
  std::vector<std::set<std::uint32_t>> neighbours(cells);
  for (const auto& [a, b] : edges) {
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  spec::Topology t;
  t.neurons_per_cell = neurons_per_cell;
  t.first_link.push_back(0);
  for (const auto& row : neighbours) {
    t.link_to.insert(t.link_to.end(), row.begin(), row.end());
    t.first_link.push_back(static_cast<std::uint32_t>(t.link_to.size()));
  }
  return t;
}

spec::Topology grid_topology(std::size_t rows, std::size_t columns, bool diagonals, int neurons_per_cell) {
  Edges edges;
  const auto cell = [&](std::size_t r, std::size_t c) { return static_cast<std::uint32_t>(r * columns + c); };
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c) {
      if (c + 1 < columns) edges.push_back({cell(r, c), cell(r, c + 1)});
      if (r + 1 < rows) edges.push_back({cell(r, c), cell(r + 1, c)});
      if (diagonals && r + 1 < rows && c + 1 < columns) {
        edges.push_back({cell(r, c), cell(r + 1, c + 1)});
        edges.push_back({cell(r, c + 1), cell(r + 1, c)});
      }
    }
  return topology_of(rows * columns, neurons_per_cell, edges);
}

spec::Topology ring_topology(std::size_t cells, int neurons_per_cell) {
  Edges edges;
  for (std::uint32_t c = 0; c < cells; ++c)
    if (cells > 1) edges.push_back({c, static_cast<std::uint32_t>((c + 1) % cells)});
  return topology_of(cells, neurons_per_cell, edges);
}

spec::Topology random_topology(Dice& dice, std::size_t most_cells) {
  const int per_cell = static_cast<int>(dice.between(1, 3));
  const std::size_t cells =
      1 + dice.below(dice.one_in(3) ? std::min<std::size_t>(most_cells, 12) : most_cells);
  switch (dice.below(10)) {
  case 0:
    return topology_of(1, per_cell, {});
  case 1:
    return topology_of(cells, per_cell, {}); // isolated cells
  case 2:
    return ring_topology(cells, per_cell);
  case 3:
  case 4: {
    const std::size_t rows = 1 + dice.below(cells);
    return grid_topology(rows, std::max<std::size_t>(1, cells / rows), dice.one_in(2), per_cell);
  }
  case 5:
    return topology_of(cells, per_cell, star_edges(cells)); // one row much longer than all others
  case 6: {
    const std::size_t few = std::min<std::size_t>(cells, 24);
    return topology_of(few, per_cell, all_edges(few)); // a colour a cell
  }
  default:
    return topology_of(cells, per_cell, random_edges(dice, cells));
  }
}

spec::ArraySpec random_array(Dice& dice, std::size_t taps) {
  spec::ArraySpec a;
  a.name = "random";
  do {
    a.schedule = dice.mode<spec::Schedule>(spec::schedule_names);
    a.output = dice.one_in(4) ? spec::Output::binary : spec::Output::modified;
    a.normaliser = dice.mode<spec::Normaliser>(spec::normaliser_names);
    a.lanes = static_cast<int>(dice.one_in(4) ? dice.between(1, spec::most_lanes) : dice.between(1, 6));
    a.reciprocal_bits =
        static_cast<int>(dice.between(spec::least_reciprocal_bits, spec::most_reciprocal_bits));
    a.bus_bits = spec::bus_widths[dice.below(spec::bus_widths.size())];
    a.packing = dice.one_in(2);
    a.exact_accumulator = dice.one_in(2);
    for (const spec::SignalClass& signal : spec::signal_classes)
      if (signal.format != &spec::Formats::accumulator) {
        const bool as_state = signal.format == &spec::Formats::link && dice.one_in(2);
        spec::NumberFormat& format = a.formats.*signal.format;
        if (as_state)
          format = a.formats.state;
        else
          format = random_format(dice, signal.least_integer_bits);
      }
    a.formats.accumulator = random_format(dice, 1);
    a.formats.accumulator.width = static_cast<int>(dice.between(spec::least_width, spec::most_sum_width));
    const int width = a.formats.accumulator.width;
    a.formats.accumulator.integer_bits =
        static_cast<int>(dice.between(1, std::min(width, dice.one_in(2) ? 12 : spec::most_sum_width)));
  } while (spec::validate(a, taps));
  return a;
}

void fold_at_random(Dice& dice, spec::ArraySpec& a) {
  const auto most = static_cast<std::uint64_t>(spec::most_pipeline(a));
  a.pipeline = dice.one_in(2) ? 0 : static_cast<int>(dice.below(most + 1));
  if (dice.one_in(3)) return;
  a.elements = static_cast<int>(dice.one_in(4) ? dice.between(1, 200) : dice.between(1, 9));
  a.stages = dice.mode<spec::Stages>(spec::stages_names);
}

spec::ArraySpec stepping_array(Dice& dice, spec::ArraySpec a, std::size_t taps) {
  const spec::ArraySpec before = a;
  a.output = dice.one_in(2) ? spec::Output::projected : spec::Output::momentum;
  a.schedule = a.output == spec::Output::momentum ? spec::Schedule::synchronous
               : dice.one_in(2)                   ? spec::Schedule::coloured
                                                  : spec::Schedule::sequential;
  a.normaliser = dice.one_in(2) ? spec::Normaliser::reciprocal : spec::Normaliser::divider;
  a.pipeline = dice.one_in(2) ? 0 : static_cast<int>(dice.between(0, spec::most_pipeline(a)));
  if (dice.one_in(2)) a.relaxation = static_cast<int>(dice.between(1, spec::most_relaxation));
  a.momentum_entries = static_cast<int>(dice.one_in(8) ? dice.between(1, 300) : dice.between(1, 6));
  return spec::validate(a, taps) ? before : a;
}

namespace {

/// The sequence of docs/method/theory.md, a constant, anything at all, or anything not below zero.
std::vector<std::int32_t> random_table(Dice& dice, std::size_t entries) {
  const std::uint64_t character = dice.below(4);
  const std::int64_t constant = dice.code(spec::momentum_format), most = spec::momentum_format.max_raw();
  std::vector<std::int32_t> table;
  for (double t = 1; table.size() < entries;) {
    const double next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    const auto sequence = static_cast<std::int64_t>(std::floor((t - 1) / next * 0x1p15 + 0.5));
    t = next;
    const std::int64_t code = character == 0   ? std::min(sequence, most)
                              : character == 1 ? constant
                              : character == 2 ? dice.code(spec::momentum_format)
                                               : dice.between(0, most);
    table.push_back(static_cast<std::int32_t>(code));
  }
  return table;
}

spec::StopRule random_rule(Dice& dice) {
  spec::StopRule rule;
  rule.by_sum = dice.one_in(2);
  if (!dice.one_in(3))
    rule.share = static_cast<int>(dice.one_in(4) ? dice.between(1, most_share) : dice.between(1, 6));
  if (dice.one_in(2)) rule.floor = dice.bits() >> dice.between(1, 63);
  return rule;
}

} // namespace

void vary_stage(Dice& dice, ArrayJob& job) {
  if (dice.one_in(2)) job.array = stepping_array(dice, job.array, job.topology.most_taps());
  vary_run(dice, job);
}

void vary_run(Dice& dice, ArrayJob& job) {
  job.momentum = random_table(dice, table_entries(job.array));
  job.rule = random_rule(dice);
}

ArrayJob random_codes(Dice& dice, const spec::ArraySpec& array, const spec::Topology& topology) {
  ArrayJob job;
  job.array = array;
  job.topology = topology;
  job.weight.resize(topology.weight_words());
  for (std::size_t c = 0; c < topology.cells(); ++c)
    for (int p = 0; p < topology.neurons_per_cell; ++p)
      fill(dice, array.formats.weight, &job.weight[topology.row_offset(c, p)], topology.taps(c));
  // Biases take those few characters, too, cell by cell, so that whole rows of zeros and of extremes occur.
  job.bias.resize(topology.neurons());
  for (std::size_t k = 0; k < topology.neurons(); ++k) fill(dice, array.formats.bias, &job.bias[k], 1);
  job.start.resize(topology.neurons());
  const std::int64_t one = array.formats.state.one_raw();
  for (std::int32_t& v : job.start) {
    const std::uint64_t kind = dice.below(4);
    v = static_cast<std::int32_t>(kind == 0   ? (dice.one_in(2) ? one : -one)
                                  : kind == 1 ? dice.code(array.formats.state) // clamped by the array
                                              : dice.between(-one, one));
  }
  job.threshold =
      dice.one_in(3) ? 0 : static_cast<std::uint32_t>(dice.below(static_cast<std::uint64_t>(one) / 4 + 2));
  job.max_sweeps = static_cast<std::uint32_t>(dice.below(dice.one_in(4) ? 30 : 6)); // 0 is taken as 1
  return job;
}

ArrayJob random_job(std::uint64_t seed, std::size_t most_cells) {
  Dice dice(seed);
  const spec::Topology topology = random_topology(dice, most_cells);
  ArrayJob job = random_codes(dice, random_array(dice, topology.most_taps()), topology);
  fold_at_random(dice, job.array); // last, so that a seed makes the network that it made before arrays folded
  vary_stage(dice, job);           // and before they had such stages
  return job;
}

std::string describe(const ArrayJob& job) {
  spec::ArraySpec array = job.array;
  std::string text =
      std::to_string(job.topology.cells()) + " cells of " + std::to_string(job.topology.neurons_per_cell);
  for (const spec::ArrayKey& key : spec::answer_keys(spec::array_keys(array)))
    text += ", " + key.word() + " " + key.value();
  text += ", threshold " + std::to_string(job.threshold) + ", max_sweeps " + std::to_string(job.max_sweeps);
  if (!job.rule.by_sum) return text;
  return text + ", stop by sum, share " + std::to_string(job.rule.share) + ", floor " +
         std::to_string(job.rule.floor);
}

} // namespace hopmesh::cosim
