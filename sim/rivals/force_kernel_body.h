#pragma once
// The loops of force_kernel.h, included once for each instruction set.
#include "sim/rivals/force_kernel.h"

#include <cmath>

namespace hopmesh::rivals {
namespace {

// What a spring's ends differ by becomes its pull on the first of them.
inline double pull_scale(double k, double rest, double square) {
  const double root = std::sqrt(square), length = root > shortest_spring ? root : shortest_spring;
  return k - k * (rest / length);
}

// A row whose springs are further apart than any machine's lanes: read, computed and added in one loop, so
// that roots and divisions, the slowest instructions, overlap with all others. Springs s and s + distance
// share a node; safelen says so.
inline constexpr std::ptrdiff_t most_lanes = 8;
inline void pull_wide_row(const Block& row, std::ptrdiff_t nodes, const double* x, double* f) {
  const double *const y = x + nodes, *const z = y + nodes;
  double *const fy = f + nodes, *const fz = fy + nodes;
  const std::ptrdiff_t count = row.count, apart = row.distance;
  const double *const k = row.stiffness, *const rest = row.rest;
#pragma omp simd safelen(8)
  for (std::ptrdiff_t s = 0; s < count; ++s) {
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

/// Scratch on the stack: passes allocate nothing and may run on several threads.
struct Pulls {
  alignas(64) double component[3][block_size];

  void scale(const Block& block) {
    for (std::ptrdiff_t s = 0; s < block.count; ++s) {
      double &x = component[0][s], &y = component[1][s], &z = component[2][s];
      const double factor = pull_scale(block.stiffness[s], block.rest[s], x * x + y * y + z * z);
      x *= factor;
      y *= factor;
      z *= factor;
    }
  }
};

/// The value at the second end of each spring less that at its first.
inline void read_spans(const Block& block, const double* value, double* span) {
  if (block.distance == 0) {
    for (std::ptrdiff_t s = 0; s < block.count; ++s) span[s] = value[block.to[s]] - value[block.from[s]];
    return;
  }
  const double *const from = value + block.node, *const to = from + block.distance;
  for (std::ptrdiff_t s = 0; s < block.count; ++s) span[s] = to[s] - from[s];
}

/// Adds a term of each spring to its first end, and `at_end` times it to its second. Neighbouring springs
/// share nodes: in a row all starts are added before all ends.
template <int at_end>
inline void add_to_ends(const Block& block, const double* __restrict term, double* __restrict value) {
  if (block.distance == 0) {
    for (std::ptrdiff_t s = 0; s < block.count; ++s) {
      value[block.from[s]] += term[s];
      value[block.to[s]] += at_end * term[s];
    }
    return;
  }
  double* const __restrict from = value + block.node;
  for (std::ptrdiff_t s = 0; s < block.count; ++s) from[s] += term[s];
  double* const __restrict to = from + block.distance;
  for (std::ptrdiff_t s = 0; s < block.count; ++s) to[s] += at_end * term[s];
}

inline bool is_wide(const Block& block) {
  return block.distance >= most_lanes;
}

inline void pull_narrow(const Block& block, std::ptrdiff_t nodes, const double* position, double* force) {
  Pulls pulls;
  for (std::ptrdiff_t p = 0; p < 3; ++p) read_spans(block, position + p * nodes, pulls.component[p]);
  pulls.scale(block);
  for (std::ptrdiff_t p = 0; p < 3; ++p) add_to_ends<-1>(block, pulls.component[p], force + p * nodes);
}

inline void pull_block(const Block& block, std::ptrdiff_t nodes, const double* position, double* force) {
  if (is_wide(block))
    pull_wide_row(block, nodes, position + block.node, force + block.node);
  else
    pull_narrow(block, nodes, position, force);
}

inline void kick_all(std::ptrdiff_t count, double kept, double time, const double* force,
                     const double* inverse_mass, const double* external, double* velocity) {
#pragma omp simd
  for (std::ptrdiff_t k = 0; k < count; ++k)
    velocity[k] = kept * velocity[k] + time * (force[k] * inverse_mass[k] + external[k]);
}

} // namespace
} // namespace hopmesh::rivals
