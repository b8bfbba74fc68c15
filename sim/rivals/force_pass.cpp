// Springs in rows: how they are found, and the pass over them.
#include "sim/rivals/force_pass.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::rivals {
namespace {

constexpr Eigen::Index block_size = 128;
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

// What a spring's ends differ by becomes its pull on the first of them.
double pull_scale(double k, double rest, double square) {
  const double root = std::sqrt(square), length = root > shortest_spring ? root : shortest_spring;
  return k - k * (rest / length);
}

// A row whose springs are further apart than any machine's lanes: read, computed and added in one loop, so
// that roots and divisions, the slowest instructions, overlap with all others. Springs s and s + apart share
// a node; safelen says so.
constexpr Eigen::Index most_lanes = 8;
void pull_row(Eigen::Index count, Eigen::Index apart, Eigen::Index nodes, const double* k, const double* rest,
              const double* x, double* f) {
  const double *const y = x + nodes, *const z = y + nodes;
  double *const fy = f + nodes, *const fz = fy + nodes;
#pragma omp simd safelen(8)
  for (Eigen::Index s = 0; s < count; ++s) {
    const double dx = x[s + apart] - x[s], dy = y[s + apart] - y[s], dz = z[s + apart] - z[s];
    const double scale = pull_scale(k[s], rest[s], dx * dx + dy * dy + dz * dz);
    f[s] += dx * scale;
    fy[s] += dy * scale;
    fz[s] += dz * scale;
    f[s + apart] -= dx * scale;
    fy[s + apart] -= dy * scale;
    fz[s + apart] -= dz * scale;
  }
}

} // namespace

/// Scratch of a pass, on the stack: passes allocate nothing and may run on several threads.
struct ForcePass::Block {
  alignas(64) double x[block_size], y[block_size], z[block_size], length[block_size];
};

ForcePass::ForcePass(std::size_t nodes, const std::vector<scene::Spring>& springs)
    : nodes_(static_cast<Eigen::Index>(nodes)) {
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
    blocks_.push_back({first + at, std::min(block_size, count - at), 0, 0});
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
    blocks_.push_back({first + at, std::min(block_size, count - at), node + at, apart});
}

void ForcePass::differences(const Row& block, const double* position, Block& d) const {
  double* const component[] = {d.x, d.y, d.z};
  for (Eigen::Index p = 0; p < 3; ++p) {
    double* const __restrict difference = component[p];
    const double* const all = position + p * nodes_;
    if (block.distance == 0) {
      for (Eigen::Index s = 0; s < block.count; ++s)
        difference[s] = all[to_[block.first + s]] - all[from_[block.first + s]];
    } else {
      const double *const from = all + block.node, *const to = from + block.distance;
      for (Eigen::Index s = 0; s < block.count; ++s) difference[s] = to[s] - from[s];
    }
  }
}

void ForcePass::lengths(const Row& block, Block& d) const {
  for (Eigen::Index s = 0; s < block.count; ++s)
    d.length[s] = std::sqrt(d.x[s] * d.x[s] + d.y[s] * d.y[s] + d.z[s] * d.z[s]);
}

void ForcePass::spread(const Row& block, const Block& d, double* force) const {
  const double* const component[] = {d.x, d.y, d.z};
  for (Eigen::Index p = 0; p < 3; ++p) {
    const double* const __restrict pull = component[p];
    double* const all = force + p * nodes_;
    if (block.distance == 0) {
      for (Eigen::Index s = 0; s < block.count; ++s) {
        all[from_[block.first + s]] += pull[s];
        all[to_[block.first + s]] -= pull[s];
      }
    } else {
      double* const __restrict from = all + block.node, * const __restrict to = from + block.distance;
      for (Eigen::Index s = 0; s < block.count; ++s) from[s] += pull[s];
      for (Eigen::Index s = 0; s < block.count; ++s) to[s] -= pull[s];
    }
  }
}

void ForcePass::forces(In position, Out force) const {
  force.setZero();
  Block d;
  for (const Row& block : blocks_) {
    const double *const k = &stiffness_[block.first], *const rest = &rest_[block.first];
    if (block.distance >= most_lanes) {
      pull_row(block.count, block.distance, nodes_, k, rest, position.data() + block.node,
               force.data() + block.node);
      continue;
    }
    differences(block, position.data(), d);
    for (Eigen::Index s = 0; s < block.count; ++s) {
      const double scale = pull_scale(k[s], rest[s], d.x[s] * d.x[s] + d.y[s] * d.y[s] + d.z[s] * d.z[s]);
      d.x[s] *= scale;
      d.y[s] *= scale;
      d.z[s] *= scale;
    }
    spread(block, d, force.data());
  }
}

double ForcePass::energy(In position) const {
  Block d;
  double sum = 0;
  for (const Row& block : blocks_) {
    differences(block, position.data(), d);
    lengths(block, d);
    for (Eigen::Index s = 0; s < block.count; ++s) {
      const double stretch = d.length[s] - rest_[block.first + s];
      d.x[s] = stiffness_[block.first + s] / 2 * stretch * stretch;
    }
    sum += Eigen::Map<const Eigen::ArrayXd>(d.x, block.count).sum();
  }
  return sum;
}

} // namespace hopmesh::rivals
