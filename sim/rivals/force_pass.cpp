// Springs in rows: how they are found, and the pass over them.
#include "sim/rivals/force_pass.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::rivals {
namespace {

constexpr std::uint32_t widest_gap = 2; // springs missing in a row are cheaper left idle than begun anew
constexpr std::size_t shortest_row = 8;

std::uint32_t distance(const scene::Spring& spring) {
  return spring.node[1] - spring.node[0];
}

bool in_row_order(const scene::Spring& a, const scene::Spring& b) {
  return std::make_pair(distance(a), a.node[0]) < std::make_pair(distance(b), b.node[0]);
}

bool continues(const scene::Spring& before, const scene::Spring& spring) {
  return distance(spring) == distance(before) && spring.node[0] > before.node[0] &&
         spring.node[0] - before.node[0] <= widest_gap + 1;
}

} // namespace

ForcePass::ForcePass(std::size_t nodes, const std::vector<scene::Spring>& springs, const ForceKernel& kernel)
    : nodes_(static_cast<Eigen::Index>(nodes)), kernel_(kernel) {
  std::vector<scene::Spring> sorted = springs, single;
  std::sort(sorted.begin(), sorted.end(), in_row_order);
  for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
    for (end = begin + 1; end < sorted.size() && continues(sorted[end - 1], sorted[end]);) ++end;
    if (end - begin >= shortest_row)
      add_row(sorted, begin, end);
    else
      single.insert(single.end(), sorted.begin() + begin, sorted.begin() + end);
  }
  const auto first = static_cast<Eigen::Index>(from_.size());
  for (const scene::Spring& spring : single) add(spring);
  const auto count = static_cast<Eigen::Index>(single.size());
  for (Eigen::Index at = 0; at < count; at += block_size)
    rows_.push_back({first + at, std::min(block_size, count - at), 0, 0});
}

void ForcePass::add(const scene::Spring& spring) {
  from_.push_back(spring.node[0]);
  to_.push_back(spring.node[1]);
  stiffness_.push_back(2 * spring.weight);
  rest_.push_back(spring.rest_length);
}

void ForcePass::add_row(const std::vector<scene::Spring>& sorted, std::size_t begin, std::size_t end) {
  const auto first = static_cast<Eigen::Index>(from_.size());
  const std::uint32_t node = sorted[begin].node[0], apart = distance(sorted[begin]);
  for (std::size_t s = begin; s < end; ++s) {
    std::uint32_t next = node + static_cast<std::uint32_t>(from_.size() - static_cast<std::size_t>(first));
    for (; next < sorted[s].node[0]; ++next) add({{next, next + apart}, 0, 0});
    add(sorted[s]);
  }
  const auto count = static_cast<Eigen::Index>(from_.size()) - first;
  for (Eigen::Index at = 0; at < count; at += block_size)
    rows_.push_back({first + at, std::min(block_size, count - at), node + at, apart});
}

void ForcePass::forces(In position, Out force) const {
  force.setZero();
  each_block(
      [&](const Block& block, Eigen::Index) { kernel_.pull(block, nodes_, position.data(), force.data()); });
}

double ForcePass::energy(In position) const {
  double sum = 0;
  for (std::size_t s = 0; s < stiffness_.size(); ++s) {
    double square = 0;
    for (Eigen::Index p = 0; p < 3; ++p) {
      const double d = position[p * nodes_ + to_[s]] - position[p * nodes_ + from_[s]];
      square += d * d;
    }
    const double stretch = std::sqrt(square) - rest_[s];
    sum += stiffness_[s] / 2 * stretch * stretch;
  }
  return sum;
}

} // namespace hopmesh::rivals
