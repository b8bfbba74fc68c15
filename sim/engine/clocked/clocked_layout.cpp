#include "sim/engine/clocked/clocked_layout.h"

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

// Rows of n beats accumulate in n, are normalised in as many as that takes, and pulled behind it.
void list_beats(ClockedBank& bank, const spec::ArraySpec& array) {
  const auto places = [](std::size_t number) { return static_cast<std::uint32_t>(number); };
  const std::uint64_t length = bank.beats() + spec::stage_cycles(array);
  for (std::uint64_t b = 0; b < length; ++b) {
    const auto normalised = bank.with_beats_over(b, b + 1, spec::drive_cycles(array));
    const auto pulled = bank.with_beats_over(b, b + 1, spec::change_cycles(array));
    bank.beat.push_back({b < bank.beats() ? places(bank.reach[b]) : 0, places(normalised.first),
                         places(normalised.second), places(pulled.first), places(pulled.second)});
  }
}

} // namespace

// A bank of one cell is worked on row by row; all others in full lanes.
ClockedLayout::ClockedLayout(const spec::ArraySpec& array, const spec::Topology& t,
                             const spec::Phases& phases)
    : bank_of_cell(t.cells(), 0), place_of_cell(t.cells(), 0) {
  const std::size_t unit = array.schedule == spec::Schedule::sequential ? 1 : lane_count;
  const auto members = cells_of_banks(t, phases, array.schedule);
  for (const auto& cells : members) place(cells, array, t, unit);
  find_runs(members, t);
}

void ClockedLayout::place(std::vector<std::uint32_t> cells, const spec::ArraySpec& array,
                          const spec::Topology& t, std::size_t unit) {
  const auto lanes = static_cast<std::size_t>(array.lanes);
  const auto per_cell = static_cast<std::size_t>(t.neurons_per_cell);
  const auto beats_of = [&](std::uint32_t c) { return (t.taps(c) + lanes - 1) / lanes; };
  std::stable_sort(cells.begin(), cells.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return t.taps(a) > t.taps(b); });
  ClockedBank bank;
  bank.taps = t.taps(cells.front());
  bank.first_row = rows;
  bank.first_weight = weights;
  bank.reach.assign(beats_of(cells.front()) + 1, 0);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    bank_of_cell[cells[k]] = static_cast<std::uint32_t>(banks.size());
    place_of_cell[cells[k]] = static_cast<std::uint32_t>(bank.width++);
    const std::size_t beats = beats_of(cells[k]);
    if (k + 1 < cells.size() && beats_of(cells[k + 1]) == beats) continue;
    bank.width = (bank.width + unit - 1) / unit * unit;
    std::fill_n(bank.reach.begin(), beats, bank.width);
  }
  rows += per_cell * bank.width;
  weights += per_cell * bank.taps * bank.width;
  inputs = std::max(inputs, bank.taps * bank.input_stride());
  list_beats(bank, array);
  banks.push_back(std::move(bank));
}

void ClockedLayout::find_runs(const std::vector<std::vector<std::uint32_t>>& cells, const spec::Topology& t) {
  for (std::size_t b = 0; b < banks.size(); ++b) {
    ClockedBank& bank = banks[b];
    bank.runs.resize(bank.taps / static_cast<std::size_t>(t.neurons_per_cell) - 1);
    for (std::size_t k = 0; k < bank.runs.size(); ++k) {
      std::vector<std::uint32_t> source(bank.width, static_cast<std::uint32_t>(b)), row(bank.width);
      for (std::size_t w = 0; w < bank.width; ++w) row[w] = static_cast<std::uint32_t>(bank.first_row + w);
      for (std::uint32_t c : cells[b]) {
        if (k >= t.degree(c)) continue;
        const std::uint32_t other = t.link_to[t.first_link[c] + k];
        source[place_of_cell[c]] = bank_of_cell[other];
        row[place_of_cell[c]] = static_cast<std::uint32_t>(this->row(other, 0));
      }
      for (std::uint32_t w = 0; w < bank.width; ++w) {
        const bool goes_on = w > 0 && source[w] == source[w - 1] && row[w] == row[w - 1] + 1;
        if (goes_on)
          bank.runs[k].back().count += 1;
        else
          bank.runs[k].push_back({w, 1, row[w], static_cast<std::uint32_t>(banks[source[w]].width)});
      }
    }
  }
}

} // namespace hopmesh::engine
