// The loops of block_kernel.h, included once for each instruction set.
#include "sim/reference/block_kernel.h"

namespace hopmesh::reference {
namespace {

using Four = double __attribute__((vector_size(32), may_alias));

inline const Four* fours(const Quad* quads) {
  return reinterpret_cast<const Four*>(quads);
}
inline Four* fours(Quad* quads) {
  return reinterpret_cast<Four*>(quads);
}

inline double total(const Four& sums) {
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// Adds to `sum` what `count` blocks bring; a sum for each column, so that no addition waits for the last.
template <std::size_t n>
inline void add_blocks(const Four* weight, const std::uint32_t* source, std::size_t count, const Quad* V,
                       Four& sum) {
  Four second{}, third{};
  for (std::size_t k = 0; k < count; ++k, weight += n) {
    const double* v = V[source[k]].lane;
    sum += weight[0] * v[0];
    if (n > 1) second += weight[1] * v[1];
    if (n > 2) third += weight[2] * v[2];
  }
  sum += second + third;
}

/// s of a node's neurons but for what they do to each other.
template <std::size_t n>
inline void add_sources(const BlockRows& rows, std::size_t node, const Quad* V, Four& sum) {
  const std::uint32_t from = rows.first[node];
  add_blocks<n>(fours(rows.weight) + n * from, rows.source + from, rows.first[node + 1] - from, V, sum);
}

template <std::size_t n> void inputs_of(const BlockRows& rows, const Quad* bias, const Quad* V, Quad* s) {
  for (std::size_t node = 0; node < rows.nodes; ++node) {
    Four sum = fours(bias)[node];
    add_sources<n>(rows, node, V, sum);
    const auto self = static_cast<std::uint32_t>(node);
    add_blocks<n>(fours(rows.own) + n * node, &self, 1, V, sum);
    fours(s)[node] = sum;
  }
}

// Paper eqs. 10 to 12, with R u = u - V |u|: no neuron waits for a comparison.
inline double fired(double s, double share, double V) {
  const double u = s * share;
  return V + (u - V * __builtin_fabs(u));
}

/// Nodes whose inputs are summed before the first of them fires: what a node's neurons wait for each other,
/// the other nodes fill.
inline constexpr std::size_t batch = 32;

template <std::size_t n>
void fire_batch(const BlockRows& rows, const Quad* bias, const std::uint32_t* node, std::size_t count,
                Quad* V) {
  Four sums[batch];
  for (std::size_t k = 0; k < count; ++k) {
    sums[k] = fours(bias)[node[k]];
    add_sources<n>(rows, node[k], V, sums[k]);
  }
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = node[k];
      double* const v = V[at].lane;
      const Quad* const own = rows.own + n * at;
      double s = sums[k][p];
      for (std::size_t q = 0; q < n; ++q) s += own[q].lane[p] * v[q];
      v[p] = fired(s, rows.share[at].lane[p], v[p]);
    }
}

template <std::size_t n>
void sweep_over(const BlockRows& rows, const Quad* bias, const std::uint32_t* node, std::size_t count,
                Quad* V) {
  for (; count > batch; node += batch, count -= batch) fire_batch<n>(rows, bias, node, batch, V);
  fire_batch<n>(rows, bias, node, count, V);
}

inline void inputs(const BlockRows& rows, const Quad* bias, const Quad* V, Quad* s) {
  if (rows.components == 3) return inputs_of<3>(rows, bias, V, s);
  if (rows.components == 2) return inputs_of<2>(rows, bias, V, s);
  inputs_of<1>(rows, bias, V, s);
}

inline void sweep(const BlockRows& rows, const Quad* bias, const std::uint32_t* node, std::size_t count,
                  Quad* V) {
  if (rows.components == 3) return sweep_over<3>(rows, bias, node, count, V);
  if (rows.components == 2) return sweep_over<2>(rows, bias, node, count, V);
  sweep_over<1>(rows, bias, node, count, V);
}

inline void turn(std::size_t nodes, const Quad* step, const Quad* free, double kept, Quad* direction) {
  for (std::size_t k = 0; k < nodes; ++k)
    fours(direction)[k] = fours(step)[k] * fours(free)[k] + kept * fours(direction)[k];
}

inline void bend(std::size_t nodes, const DescentFields& at, double& curvature, double& most) {
  Four bent{}, allowed{};
  for (std::size_t k = 0; k < nodes; ++k) {
    const Four d = fours(at.direction)[k];
    bent -= d * fours(at.change)[k];
    allowed += fours(at.reach)[k] * d * d;
  }
  curvature = total(bent);
  most = total(allowed);
}

inline Standing walk(std::size_t nodes, const DescentFields& from, double far, Quad* V, Quad* s, Quad* free) {
  const Four none{}, one = none + 1;
  Four slope{}, inward{}, farthest{}, edge{};
  for (std::size_t k = 0; k < nodes; ++k) {
    const Four d = fours(from.direction)[k], step = fours(from.step)[k];
    const Four v = fours(from.V)[k] + far * d, here = fours(from.s)[k] + far * fours(from.change)[k];
    fours(V)[k] = v;
    fours(s)[k] = here;
    const Four size = v < none ? -v : v;
    const Four moved = d != none ? size : none;
    edge = moved > edge ? moved : edge;
    const Four between = size < one ? here : none, wanted = step * here;
    fours(free)[k] = between;
    slope += between * step * between;
    Four there = v + wanted;
    there = there > one ? one : there;
    there = there < -one ? -one : there;
    const Four way = there < v ? v - there : there - v;
    const Four leaves = way > none ? here : none, away = size < one ? none : here * v < none ? leaves : none;
    inward += away * step * away;
    farthest = way > farthest ? way : farthest;
  }
  Standing standing{total(slope), total(inward), 0, true};
  for (std::size_t p = 0; p < 4; ++p) {
    if (farthest[p] > standing.violation) standing.violation = farthest[p];
    standing.inside = standing.inside && edge[p] < 1;
  }
  return standing;
}

} // namespace
} // namespace hopmesh::reference
