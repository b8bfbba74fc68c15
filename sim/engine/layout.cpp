#include "sim/engine/layout.h"

namespace hopmesh::engine {

namespace {

// Every cell fires after its neighbours of lower number and before those of higher number; cells of one level
// are never linked.
std::vector<std::uint32_t> levels(const spec::Topology& t) {
  std::vector<std::uint32_t> level(t.cells(), 0);
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1] && t.link_to[k] < c; ++k)
      level[c] = std::max(level[c], level[t.link_to[k]] + 1);
  return level;
}

/// Which groups are linked across chunks: [groups][groups].
std::vector<bool> linked_across(const spec::Topology& t, const std::vector<std::uint32_t>& group,
                                std::size_t groups, std::size_t chunk_cells) {
  std::vector<bool> across(groups * groups, false);
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k)
      if (c / chunk_cells != t.link_to[k] / chunk_cells)
        across[group[c] * groups + group[t.link_to[k]]] = true;
  return across;
}

bool links_end_in_next_chunk(const spec::Topology& t, std::size_t chunk_cells) {
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k)
      if (t.link_to[k] / chunk_cells > c / chunk_cells + 1) return false;
  return true;
}

// A run of whole rows of a grid keeps the links along a row inside: then fewer groups meet across chunks, and
// sweeps follow each other more closely. Rows are as long as links reach, or one cell shorter where the
// diagonals are linked too.
std::size_t chunk_for_links(const spec::Topology& t, const std::vector<std::uint32_t>& group,
                            std::size_t groups, std::size_t wanted) {
  const std::size_t reach = link_reach(t);
  std::size_t best = std::max(wanted, reach), fewest = SIZE_MAX;
  for (std::size_t row = std::max<std::size_t>(reach, 2) - 1; row <= reach; ++row) {
    const std::size_t rows = (wanted + row - 1) / row * row;
    if (!links_end_in_next_chunk(t, rows)) continue;
    const std::vector<bool> across = linked_across(t, group, groups, rows);
    const auto pairs = static_cast<std::size_t>(std::count(across.begin(), across.end(), true));
    if (pairs < fewest) fewest = pairs, best = rows;
  }
  return best;
}

// Where all cells fire at once, chunks without an empty lane leave every link as long as it is in cell
// numbers.
std::size_t whole_blocks(std::size_t cells) {
  return (cells + block_lanes - 1) / block_lanes * block_lanes;
}

// Inputs of cells in blocks, where every row of a block is as long as its longest.
std::size_t padded_inputs(const spec::Topology& t, const std::vector<std::uint32_t>& cells) {
  std::size_t inputs = 0, longest = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    longest = std::max(longest, 1 + t.degree(cells[k]));
    if (k % block_lanes != block_lanes - 1 && k + 1 < cells.size()) continue;
    inputs += longest;
    longest = 0;
  }
  return inputs;
}

// A mesh's rows are nearly of one length, and neighbours that lie side by side are worth more than the rest.
void even_out(const spec::Topology& t, std::vector<std::uint32_t>& cells) {
  std::vector<std::uint32_t> sorted = cells;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&t](std::uint32_t a, std::uint32_t b) { return t.degree(a) > t.degree(b); });
  if (4 * padded_inputs(t, sorted) < 3 * padded_inputs(t, cells)) cells.swap(sorted);
}

} // namespace

std::vector<std::uint32_t> groups_of_cells(const spec::Topology& t, const spec::Phases& phases,
                                           spec::Schedule schedule) {
  if (schedule == spec::Schedule::sequential) return levels(t);
  std::vector<std::uint32_t> group(t.cells(), 0);
  if (schedule == spec::Schedule::synchronous) return group;
  for (std::size_t k = 0; k < phases.size(); ++k)
    for (std::uint32_t neuron : phases[k])
      group[neuron / t.neurons_per_cell] = static_cast<std::uint32_t>(k / t.neurons_per_cell);
  return group;
}

std::size_t link_reach(const spec::Topology& t) {
  std::size_t reach = 0;
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k)
      reach = std::max<std::size_t>(reach, t.link_to[k] > c ? t.link_to[k] - c : c - t.link_to[k]);
  return reach;
}

Layout::Layout(const spec::Topology& t, const spec::Phases& phases, spec::Schedule schedule,
               std::size_t chunk_cells) {
  const auto group = groups_of_cells(t, phases, schedule);
  for (std::uint32_t g : group) groups = std::max<std::size_t>(groups, g + 1);
  if (chunk_cells == 0)
    chunk_cells = std::max<std::size_t>(t.cells(), 1);
  else if (schedule == spec::Schedule::synchronous)
    chunk_cells = whole_blocks(std::max(chunk_cells, link_reach(t)));
  else
    chunk_cells = chunk_for_links(t, group, groups, chunk_cells);
  place(t, group, chunk_cells);
  if (chunks > 1) across_ = linked_across(t, group, groups, chunk_cells);
  find_sources(t);
}

void Layout::place(const spec::Topology& t, const std::vector<std::uint32_t>& group,
                   std::size_t chunk_cells) {
  const std::size_t cells = group.size();
  chunks = (cells + chunk_cells - 1) / chunk_cells;
  slot_of_cell.resize(cells);
  first_block.assign(1, 0);
  std::vector<std::vector<std::uint32_t>> members(groups);
  for (std::size_t r = 0; r < chunks; ++r) {
    for (auto& list : members) list.clear();
    for (std::size_t c = r * chunk_cells; c < std::min(cells, (r + 1) * chunk_cells); ++c)
      members[group[c]].push_back(static_cast<std::uint32_t>(c));
    for (auto& list : members) {
      even_out(t, list);
      for (std::uint32_t c : list) {
        slot_of_cell[c] = static_cast<std::uint32_t>(cell_of_slot.size());
        cell_of_slot.push_back(c);
      }
      cell_of_slot.resize((cell_of_slot.size() + block_lanes - 1) / block_lanes * block_lanes, no_cell);
      first_block.push_back(static_cast<std::uint32_t>(cell_of_slot.size() / block_lanes));
    }
  }
}

void Layout::find_sources(const spec::Topology& t) {
  neighbours.assign(cell_of_slot.size() / block_lanes, 0);
  for (std::uint32_t cell : cell_of_slot) {
    degree.push_back(cell == no_cell ? 0 : static_cast<std::uint32_t>(t.degree(cell)));
    std::uint32_t& most = neighbours[(degree.size() - 1) / block_lanes];
    most = std::max(most, degree.back());
  }
  first_source.assign(1, 0);
  for (std::uint32_t n : neighbours)
    first_source.push_back(first_source.back() + n * static_cast<std::uint32_t>(block_lanes));
  source.resize(first_source.back());
  for (std::size_t slot = 0; slot < cell_of_slot.size(); ++slot) {
    const std::uint32_t cell = cell_of_slot[slot];
    const std::size_t block = slot / block_lanes;
    std::size_t at = first_source[block] + slot % block_lanes;
    for (std::size_t k = 0; k < neighbours[block]; ++k, at += block_lanes)
      source[at] = k < degree[slot] ? slot_of_cell[t.link_to[t.first_link[cell] + k]]
                                    : static_cast<std::uint32_t>(slot);
  }
}

} // namespace hopmesh::engine
