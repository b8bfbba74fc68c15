#include "sim/cosim/firings/firing_columns.h"

#include "rtl_model/spec/points.h"
#include "sim/cosim/firings/firing_edges.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace hopmesh::cosim {

namespace {

constexpr int place_bits = 32;

using Shape = const NeuronShape&;

std::vector<FiringColumn> make_table() {
  const auto word = [](Shape) { return place_bits; };
  const auto state = [](Shape s) { return s.formats.state.width; };
  const auto drive = [](Shape s) { return s.drive_bits; };
  const auto link = [](Shape s) { return s.formats.link.width; };
  const auto change = [](Shape s) { return s.formats.state.width + 1; };
  return {
      {"sweep", Part::place, Count::one, false, word, "", "of the run, from 1; 0: no run made this line"},
      {"neuron", Part::place, Count::one, false, word, "", "its number in the array, or that of the line"},
      {"edges", Part::place, Count::one, false, [](Shape) { return int(firing_edges().size()); }, "",
       "what the line is an edge of"},
      {"taps", Part::place, Count::one, false, word, "", "of the row; behind them, weights are 0"},
      {"own", Part::place, Count::one, false, word, "", "the tap that is the neuron itself"},
      {"weight", Part::input, Count::taps, true, [](Shape s) { return s.formats.weight.width; }, "", "w"},
      {"link", Part::input, Count::taps, true, link, "", "L of the sources, as the phase began"},
      {"bias", Part::input, Count::one, true, [](Shape s) { return s.formats.bias.width; }, "", "I"},
      {"state", Part::input, Count::one, true, state, "", "V before"},
      {"extrapolated", Part::input, Count::one, true, state, "", "Y before; 0 without momentum"},
      {"momentum", Part::input, Count::one, true, [](Shape) { return spec::momentum_format.width; }, "",
       "m of the sweep; 0 without momentum"},
      {"sum", Part::answer, Count::sums, true, [](Shape s) { return s.formats.accumulator.width; }, "s",
       "s as the bias leaves it, then after each beat"},
      {"norm", Part::answer, Count::one, false, [](Shape s) { return s.norm_bits; }, "N",
       "what divides s: N, or \\|w\\| of the own tap; 0 where nothing does"},
      {"reciprocal", Part::answer, Count::one, false, [](Shape s) { return s.array.reciprocal_bits; }, "r",
       "r; 0 where N is 0 or there is none"},
      {"places", Part::answer, Count::one, true, [](Shape) { return place_bits; }, "r",
       "s · r · 2^−places counts in the drive's last place"},
      {"ratio", Part::answer, Count::one, true, drive, "u before the limiter",
       "u before the limiter; u where the limiter comes first"},
      {"drive", Part::answer, Count::one, true, drive, "u", "u"},
      {"pull", Part::answer, Count::one, true, change, "R", "R; 0 where there is none"},
      {"product", Part::answer, Count::one, true, [](Shape s) { return s.product_bits; }, "product",
       "R · u, or m · ΔV, exact; 0 with `projected`"},
      {"change", Part::answer, Count::one, true, change, "dV", "ΔV"},
      {"state_after", Part::answer, Count::one, true, state, "V", "V after"},
      {"extrapolated_after", Part::answer, Count::one, true, state, "Y",
       "Y after, where the sweep ends without a restart; 0 without momentum"},
      {"link_after", Part::answer, Count::one, true, link, "link", "L after"},
  };
}

std::vector<Cell> filled(const std::vector<std::int32_t>& codes, std::size_t count) {
  std::vector<Cell> cells(codes.begin(), codes.end());
  cells.resize(count, 0);
  return cells;
}

std::int64_t one_of(const FiringRow& row, const char* name) {
  return row[column_named(name)].at(0).value();
}

std::vector<std::int32_t> codes_of(const FiringRow& row, const char* name, std::size_t count) {
  std::vector<std::int32_t> codes;
  for (std::size_t k = 0; k < count; ++k)
    codes.push_back(static_cast<std::int32_t>(row[column_named(name)].at(k).value()));
  return codes;
}

bool holds(const FiringColumn& column, const NeuronShape& shape, std::int64_t x) {
  const std::int64_t top = std::int64_t{1} << (column.bits(shape) - (column.negative ? 1 : 0));
  return x < top && x >= (column.negative ? -top : 0);
}

} // namespace

const std::vector<FiringColumn>& firing_columns() {
  static const std::vector<FiringColumn> table = make_table();
  return table;
}

std::size_t count_of(const FiringColumn& column, const NeuronShape& shape) {
  if (column.count == Count::one) return 1;
  return column.count == Count::taps ? shape.taps : shape.beats + 1;
}

std::size_t column_named(const std::string& name) {
  const auto& all = firing_columns();
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].name == name) return k;
  throw std::logic_error("no column " + name);
}

FiringRow row_of(const Firing& f, const NeuronShape& shape) {
  const spec::FiringSteps& s = f.steps;
  const auto whole = [](auto x) { return std::vector<Cell>(1, static_cast<std::int64_t>(x)); };
  std::vector<Cell> sums(s.sum.begin(), s.sum.end());
  sums.resize(shape.beats + 1, s.sum.empty() ? Cell() : s.sum.back());
  return {whole(f.sweep),
          whole(f.neuron),
          whole(f.edges),
          whole(f.inputs.weight.size()),
          whole(f.inputs.own_tap),
          filled(f.inputs.weight, shape.taps),
          filled(f.inputs.link, shape.taps),
          whole(f.inputs.bias),
          whole(f.inputs.state),
          whole(f.inputs.extrapolated),
          whole(f.inputs.momentum),
          std::move(sums),
          whole(s.norm),
          whole(s.reciprocal),
          whole(s.places),
          whole(s.ratio),
          whole(s.drive),
          whole(s.pull),
          whole(s.product),
          whole(s.change),
          whole(s.state),
          whole(s.extrapolated),
          whole(s.link)};
}

Firing firing_of(const FiringRow& row) {
  Firing f;
  const auto taps = static_cast<std::size_t>(one_of(row, "taps"));
  f.sweep = static_cast<std::uint64_t>(one_of(row, "sweep"));
  f.neuron = static_cast<std::uint64_t>(one_of(row, "neuron"));
  f.edges = static_cast<std::uint32_t>(one_of(row, "edges"));
  f.inputs = {codes_of(row, "weight", taps),
              codes_of(row, "link", taps),
              static_cast<std::int32_t>(one_of(row, "bias")),
              static_cast<std::int32_t>(one_of(row, "state")),
              static_cast<std::uint32_t>(one_of(row, "own")),
              static_cast<std::int32_t>(one_of(row, "extrapolated")),
              static_cast<std::int32_t>(one_of(row, "momentum"))};
  return f;
}

std::optional<std::pair<std::string, std::string>> row_fault(const FiringRow& row, const NeuronShape& shape) {
  const auto& all = firing_columns();
  for (std::size_t c = 0; c < all.size() && all[c].part != Part::answer; ++c)
    for (const Cell& cell : row[c])
      if (!cell || !holds(all[c], shape, *cell))
        return std::pair(
            fmt::format("{} {}", all[c].name, cell ? std::to_string(*cell) : "?"),
            fmt::format("{} of {} bits", all[c].negative ? "a code" : "a number", all[c].bits(shape)));
  const std::int64_t taps = one_of(row, "taps"), state_one = shape.formats.state.one_raw(),
                     link_one = shape.formats.link.one_raw();
  if (taps < 1 || taps > static_cast<std::int64_t>(shape.taps))
    return std::pair(fmt::format("{} taps", taps), fmt::format("1 to {}", shape.taps));
  if (one_of(row, "own") >= taps)
    return std::pair(fmt::format("own {}", one_of(row, "own")), fmt::format("a tap below {}", taps));
  for (const Cell& cell : row[column_named("link")])
    if (std::abs(*cell) > link_one)
      return std::pair(fmt::format("link {}", *cell), fmt::format("at most {} either way", link_one));
  for (const char* name : {"state", "extrapolated"})
    if (std::abs(one_of(row, name)) > state_one)
      return std::pair(fmt::format("{} {}", name, one_of(row, name)),
                       fmt::format("at most {} either way", state_one));
  return std::nullopt;
}

} // namespace hopmesh::cosim
