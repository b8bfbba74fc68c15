#include "sim/engine/kernels/once_layout.h"

#include <algorithm>

namespace hopmesh::engine {

namespace {

constexpr std::size_t L = block_lanes;
constexpr std::size_t most_ways = 64; ///< more ways hardly leave two cells that share one

std::int64_t way(const Layout& layout, std::size_t slot, std::size_t k) {
  return std::int64_t{layout.source[layout.first_source[slot / L] + k * L + slot % L]} -
         static_cast<std::int64_t>(slot);
}

/// Calls visit(slot, k, way) for the links of a block.
template <typename Visit> void for_each_link(const Layout& layout, std::size_t block, Visit visit) {
  for (std::size_t slot = block * L; slot < (block + 1) * L; ++slot)
    for (std::size_t k = 0; k < layout.degree[slot]; ++k) visit(slot, k, way(layout, slot, k));
}

} // namespace

OnceLayout::OnceLayout(const Layout& layout, const FastLayout& fast, std::size_t per_cell)
    : per_cell_(per_cell), kinds_(per_cell * (per_cell + 1) / 2) {
  find_ways(layout);
  if (!fits_) return;
  std::size_t pairs_today = 0;
  for (std::uint32_t n : fast.neighbours) pairs_today += (n + 1) / 2;
  list_blocks(layout, fast);
  fits_ = fits_ && 4 * taps_.size() <= 5 * pairs_today;
}

// The commonest ways share words with each other: few blocks then read a word for one of its ways only.
void OnceLayout::find_ways(const Layout& layout) {
  std::map<std::uint32_t, std::size_t> count;
  for (std::size_t b = 0; b < layout.blocks() && count.size() <= most_ways; ++b)
    for_each_link(layout, b, [&](auto, auto, std::int64_t w) {
      if (w > 0) count[static_cast<std::uint32_t>(w)] += 1;
    });
  fits_ = !count.empty() && count.size() <= most_ways;
  if (!fits_) return;
  for (const auto& [w, cells] : count) ways_.push_back(w);
  pad_ = (ways_.back() + L) / L * L;
  std::stable_sort(ways_.begin(), ways_.end(), [&](auto a, auto b) { return count[a] > count[b]; });
  if (ways_.size() % 2 == 1) ways_.push_back(0);
  pair_count_ = ways_.size() / 2;
  // Planes an odd number of lines apart share no set of a cache.
  stride_ = layout.slots() + 2 * pad_;
  if (stride_ / L % 2 == 0) stride_ += L;
}

void OnceLayout::list_blocks(const Layout& layout, const FastLayout& fast) {
  std::map<std::vector<std::uint32_t>, std::uint32_t> known; // pairs of a list, to its number
  for (std::size_t b = 0; b < layout.blocks() && fits_; ++b) {
    first_taps_.push_back(static_cast<std::uint32_t>(taps_.size()));
    words_ += kinds_ * L;
    const auto column = columns(layout, fast, b);
    const auto& place = fast.tap_place[fast.neighbours[b]];
    std::vector<std::uint32_t> list;
    std::size_t forward = 0;
    for (const bool back : {false, true})
      for (std::size_t pair = 0; pair < pair_count_; ++pair) {
        if (!add_taps(column, place, pair, back)) continue;
        list.push_back(static_cast<std::uint32_t>(pair));
        if (!back) forward += 1, words_ += kinds_ * L;
      }
    list.push_back(static_cast<std::uint32_t>(forward));
    const auto [at, is_new] = known.try_emplace(list, static_cast<std::uint32_t>(lists_.size()));
    list_of_block_.push_back(at->second);
    if (!is_new) continue;
    const auto first = static_cast<std::uint32_t>(pairs_.size());
    for (std::size_t k = 0; k + 1 < list.size(); ++k) {
      const std::ptrdiff_t one = ways_[2 * list[k]], other = ways_[2 * list[k] + 1],
                           sign = k < forward ? 1 : -1;
      pairs_.push_back({static_cast<std::ptrdiff_t>((1 + list[k]) * kinds_ * stride_),
                        {sign * one, sign * (other ? other : one)}});
    }
    lists_.push_back(
        {first, first + static_cast<std::uint32_t>(forward), static_cast<std::uint32_t>(pairs_.size())});
  }
}

// A column that holds links of two ways, and a way that has two columns, are nothing for planes.
std::map<std::int64_t, std::uint32_t> OnceLayout::columns(const Layout& layout, const FastLayout& fast,
                                                          std::size_t block) {
  std::map<std::int64_t, std::uint32_t> column;
  std::map<std::uint32_t, std::int64_t> way_of;
  for_each_link(layout, block, [&](std::size_t slot, std::size_t k, std::int64_t w) {
    const std::uint32_t at = fast.column[fast.first_column[slot] + k];
    if (column.try_emplace(w, at).first->second != at || way_of.try_emplace(at, w).first->second != w)
      fits_ = false;
  });
  return column;
}

bool OnceLayout::add_taps(const std::map<std::int64_t, std::uint32_t>& column,
                          const std::vector<std::uint32_t>& place, std::size_t pair, bool back) {
  OnceTaps taps{};
  bool any = false;
  for (std::size_t half = 0; half < 2; ++half) {
    const std::int64_t way = ways_[2 * pair + half];
    const auto at = column.find(back ? -way : way);
    const bool there = way != 0 && at != column.end();
    any = any || there;
    for (std::size_t q = 0; q < per_cell_; ++q)
      taps.at[half][q] = there ? place[(1 + at->second) * per_cell_ + q] : OnceTaps::nowhere;
  }
  if (any) taps_.push_back(taps);
  return any;
}

void OnceLayout::point(OnceArgs& args) const {
  args.list_of_block = list_of_block_.data();
  args.lists = lists_.data();
  args.pairs = pairs_.data();
  args.stride = args.link_stride = stride_;
}

} // namespace hopmesh::engine
