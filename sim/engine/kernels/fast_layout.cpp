#include "sim/engine/kernels/fast_layout.h"

#include <algorithm>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;
constexpr std::uint32_t nobody = UINT32_MAX;

} // namespace

FastLayout::FastLayout(const Layout& layout, std::size_t per_cell, bool in_order)
    : layout_(layout), per_cell_(per_cell), in_order_(in_order) {
  align_neighbours();
  lay_out_weights();
  find_sources();
}

std::uint32_t FastLayout::neighbour(std::size_t slot, std::size_t k) const {
  return layout_.source[layout_.first_source[slot / L] + k * L + slot % L];
}

// How far off the k-th neighbour is, in cell numbers.
std::int64_t FastLayout::way(std::size_t slot, std::size_t k) const {
  return std::int64_t{layout_.cell_of_slot[neighbour(slot, k)]} - layout_.cell_of_slot[slot];
}

// Sixteen lanes find a neighbour best when it is the same way off for all of them: neighbours of one distance
// in cell numbers get a column of their own, as long as that takes few more columns than the cells have
// neighbours; or twice as many, where cells lie in their own order, since ways that have columns let weights
// be kept once. (Sums are exact, so their order is free.)
void FastLayout::align_neighbours() {
  first_column.assign(1, 0);
  for (std::size_t b = 0; b < layout_.blocks(); ++b) {
    std::vector<std::int64_t> ways;
    for (std::size_t l = 0; l < L; ++l)
      for (std::size_t k = 0; k < degree(b * L + l); ++k) ways.push_back(way(b * L + l, k));
    std::sort(ways.begin(), ways.end());
    ways.erase(std::unique(ways.begin(), ways.end()), ways.end());
    const std::size_t most = layout_.neighbours[b], wanted = ways.size();
    const bool aligned = wanted <= most + (in_order_ ? most : most / 4);
    neighbours.push_back(static_cast<std::uint32_t>(aligned ? wanted : most));
    for (std::size_t l = 0; l < L; ++l) {
      for (std::size_t k = 0; k < degree(b * L + l); ++k) {
        const auto at = std::lower_bound(ways.begin(), ways.end(), way(b * L + l, k)) - ways.begin();
        column.push_back(static_cast<std::uint16_t>(aligned ? at : static_cast<std::ptrdiff_t>(k)));
      }
      first_column.push_back(static_cast<std::uint32_t>(column.size()));
    }
  }
}

// Where each tap of a row stands, counted in 16-bit codes from the lane's first: kernel.h has the order.
void FastLayout::lay_out_weights() {
  first_weight.assign(1, 0);
  for (std::uint32_t& even : neighbours) {
    if (per_cell_ != 2) even += even % 2;
    first_weight.push_back(first_weight.back() + per_cell_ * pairs(even) * L);
    if (tap_place.size() <= even) tap_place.resize(even + 1);
    auto& place = tap_place[even];
    if (!place.empty()) continue;
    const auto code = [&](std::size_t pair, std::size_t half) {
      return static_cast<std::uint32_t>(2 * L * per_cell_ * pair + half);
    };
    for (std::size_t q = 0; q < per_cell_; ++q)
      place.push_back(q < 2 ? code(pairs(even) - 1, q) : code(pairs(even) - 2, 0));
    for (std::size_t k = 0; k < even; ++k)
      for (std::size_t q = 0; q < per_cell_; ++q)
        if (per_cell_ == 1)
          place.push_back(code(k / 2, k % 2));
        else if (per_cell_ == 2)
          place.push_back(code(k, q));
        else
          place.push_back(q == 2 ? code(k / 2 * 3 + 2, k % 2) : code(k / 2 * 3 + k % 2, q));
  }
}

void FastLayout::find_sources() {
  first_source.assign(1, 0);
  for (std::size_t b = 0; b < neighbours.size(); ++b) {
    std::vector<std::uint32_t> slots(neighbours[b] * L, nobody); // [column][lane]
    for (std::size_t slot = b * L; slot < (b + 1) * L; ++slot)
      for (std::size_t k = 0; k < degree(slot); ++k)
        slots[column[first_column[slot] + k] * L + slot % L] = neighbour(slot, k);
    for (std::size_t at = 0; at < slots.size(); at += L) add_source(b, &slots[at]);
    waits.push_back(reads_the_two_before(b));
    first_source.push_back(static_cast<std::uint32_t>(source.size()));
  }
}

// A lane without this neighbour has weight 0 and may read anything that is there, even a word that another
// thread is writing.
void FastLayout::add_source(std::size_t block, const std::uint32_t* slots) {
  std::uint32_t low = UINT32_MAX, high = 0;
  std::size_t first_real = L;
  bool together = true;
  for (std::size_t l = 0; l < L; ++l) {
    if (slots[l] == nobody) continue;
    if (first_real == L) first_real = l;
    low = std::min(low, slots[l]), high = std::max(high, slots[l]);
    together = together && slots[l] >= l && slots[l] - l == slots[first_real] - first_real;
  }
  Source s{static_cast<std::uint32_t>(block * L), Source::together, {}};
  if (first_real < L && together) {
    s.base = slots[first_real] - static_cast<std::uint32_t>(first_real);
  } else if (first_real < L && high - low < 2 * L) {
    s.kind = Source::near;
    const std::uint32_t line = low / L * L; // a load that straddles cache lines costs two
    s.base = high - line < 2 * L ? line : low;
    for (std::size_t l = 0; l < L; ++l)
      s.lane[l] = static_cast<std::uint8_t>(slots[l] != nobody ? slots[l] - s.base : 0);
  } else if (first_real < L) {
    s.kind = Source::far;
    s.base = static_cast<std::uint32_t>(far_slot.size());
    for (std::size_t l = 0; l < L; ++l)
      far_slot.push_back(slots[l] != nobody ? slots[l] : static_cast<std::uint32_t>(block * L + l));
  }
  source.push_back(s);
}

bool FastLayout::reads_the_two_before(std::size_t block) const {
  for (std::size_t slot = block * L; slot < (block + 1) * L; ++slot)
    for (std::size_t k = 0; k < degree(slot); ++k) {
      const std::size_t other = neighbour(slot, k) / L;
      if (other < block && other + 2 >= block) return true;
    }
  return false;
}

} // namespace hopmesh::engine
