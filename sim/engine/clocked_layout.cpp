#include "sim/engine/clocked_layout.h"

#include "sim/engine/lanes.h"
#include "sim/engine/layout.h"

namespace hopmesh::engine {

namespace {

std::vector<std::vector<std::uint32_t>> cells_of_banks(const spec::Topology& t, const spec::Phases& phases,
                                                       spec::Schedule schedule) {
  const auto cells = static_cast<std::uint32_t>(t.cells());
  std::vector<std::vector<std::uint32_t>> banks;
  if (schedule == spec::Schedule::sequential) {
    for (std::uint32_t c = 0; c < cells; ++c) banks.push_back({c});
    return banks;
  }
  const auto group = groups_of_cells(t, phases, schedule);
  for (std::uint32_t c = 0; c < cells; ++c) {
    if (group[c] >= banks.size()) banks.resize(group[c] + 1);
    banks[group[c]].push_back(c);
  }
  return banks;
}

} // namespace

std::pair<std::size_t, std::size_t> ClockedBank::with_beats(std::int64_t least, std::int64_t most) const {
  least = std::max<std::int64_t>(least, 1);
  most = std::min<std::int64_t>(most, static_cast<std::int64_t>(beats()));
  if (least > most) return {0, 0};
  return {reach[static_cast<std::size_t>(most)], reach[static_cast<std::size_t>(least) - 1]};
}

// A bank of one cell is worked on row by row; all others in full lanes.
ClockedLayout::ClockedLayout(const spec::ArraySpec& array, const spec::Topology& t,
                             const spec::Phases& phases)
    : bank_of_cell(t.cells(), 0), place_of_cell(t.cells(), 0) {
  const std::size_t unit = array.schedule == spec::Schedule::sequential ? 1 : lane_count;
  for (auto& cells : cells_of_banks(t, phases, array.schedule))
    place(std::move(cells), t, static_cast<std::size_t>(array.lanes), unit);
  find_sources(t);
}

void ClockedLayout::place(std::vector<std::uint32_t> cells, const spec::Topology& t, std::size_t lanes,
                          std::size_t unit) {
  const auto per_cell = static_cast<std::size_t>(t.neurons_per_cell);
  const auto beats_of = [&](std::uint32_t c) { return (t.taps(c) + lanes - 1) / lanes; };
  std::stable_sort(cells.begin(), cells.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return t.taps(a) > t.taps(b); });
  ClockedBank bank;
  bank.taps = t.taps(cells.front());
  bank.first_slot = slots;
  bank.first_row = rows;
  bank.first_weight = weights;
  bank.first_source = source.size();
  bank.reach.assign(beats_of(cells.front()) + 1, 0);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    bank_of_cell[cells[k]] = static_cast<std::uint32_t>(banks.size());
    place_of_cell[cells[k]] = static_cast<std::uint32_t>(bank.width++);
    const std::size_t beats = beats_of(cells[k]);
    if (k + 1 < cells.size() && beats_of(cells[k + 1]) == beats) continue;
    bank.width = (bank.width + unit - 1) / unit * unit;
    std::fill_n(bank.reach.begin(), beats, bank.width);
  }
  slots += bank.width;
  rows += per_cell * bank.width;
  weights += per_cell * bank.taps * bank.width;
  widest = std::max(widest, bank.taps * bank.width);
  source.resize(source.size() + (bank.taps / per_cell - 1) * bank.width);
  banks.push_back(std::move(bank));
}

void ClockedLayout::find_sources(const spec::Topology& t) {
  for (std::size_t b = 0; b < banks.size(); ++b) {
    const std::size_t end = b + 1 < banks.size() ? banks[b + 1].first_source : source.size();
    for (std::size_t k = banks[b].first_source; k < end; ++k)
      source[k] =
          static_cast<std::uint32_t>(banks[b].first_slot + (k - banks[b].first_source) % banks[b].width);
  }
  for (std::size_t c = 0; c < t.cells(); ++c) {
    const ClockedBank& bank = banks[bank_of_cell[c]];
    for (std::size_t k = 0; k < t.degree(c); ++k)
      source[bank.first_source + k * bank.width + place_of_cell[c]] =
          static_cast<std::uint32_t>(slot(t.link_to[t.first_link[c] + k]));
  }
}

} // namespace hopmesh::engine
