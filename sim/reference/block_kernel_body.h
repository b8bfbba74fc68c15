// The loops of block_kernel.h, included once for each instruction set.
#include "sim/reference/block_kernel_fours.h"

namespace hopmesh::reference {
namespace {

inline void inputs(const BlockRows& rows, const Quad* bias, const Quad* V, Quad* s) {
  const Four* weight = fours(rows.weight);
  const std::uint32_t* source = rows.source;
  for (std::size_t node = 0; node < rows.nodes; ++node) {
    const Four own = fours(V)[node], across = fours(rows.own)[2 * node + 1];
    Four straight = fours(rows.own)[2 * node] * own, crossed = across * turned(own), back = across * own;
    for (const std::uint32_t* const end = rows.source + rows.first[node + 1]; source != end;
         ++source, weight += 2) {
      const Four v = fours(V)[*source];
      straight += weight[0] * v;
      crossed += weight[1] * turned(v);
      back += weight[1] * v;
    }
    fours(s)[node] = fours(bias)[node] + (straight + crossed) + turned_back(back);
  }
}

/// Outputs of four nodes, a component in each of v and a node in each lane.
template <std::size_t n> inline void take_outputs(const Quad* V, const std::uint32_t* node, Four* v) {
  const double *const a = V[node[0]].lane, *const b = V[node[1]].lane;
  const double *const c = V[node[2]].lane, *const d = V[node[3]].lane;
  if constexpr (n == 1) {
    v[0] = Four{*a, *b, *c, *d};
  } else {
    const Four ac = joined(a, c), bd = joined(b, d);
    v[0] = __builtin_shufflevector(ac, bd, 0, 4, 2, 6);
    v[1] = __builtin_shufflevector(ac, bd, 1, 5, 3, 7);
    if constexpr (n == 3)
      v[2] = __builtin_shufflevector(joined(a + 2, c + 2), joined(b + 2, d + 2), 0, 4, 2, 6);
  }
}

/// s of a group's neurons but for what the nodes do to themselves.
template <std::size_t n> inline void sum_sources(const FiringGroup& group, const Quad* V, Four* s) {
  Four sum[n], v[n];
  for (std::size_t p = 0; p < n; ++p) sum[p] = fours(group.bias)[p];
  const Four* w = fours(group.weight);
  for (std::uint32_t k = 0; k < group.sources; ++k, w += n * (n + 1) / 2) {
    take_outputs<n>(V, group.source + 4 * std::size_t{k}, v);
    if constexpr (n == 1) {
      sum[0] += w[0] * v[0];
    } else if constexpr (n == 2) {
      sum[0] += w[0] * v[0] + w[2] * v[1];
      sum[1] += w[2] * v[0] + w[1] * v[1];
    } else {
      sum[0] += (w[0] * v[0] + w[3] * v[1]) + w[5] * v[2];
      sum[1] += (w[3] * v[0] + w[1] * v[1]) + w[4] * v[2];
      sum[2] += (w[5] * v[0] + w[4] * v[1]) + w[2] * v[2];
    }
  }
  for (std::size_t p = 0; p < n; ++p) s[p] = sum[p];
}

// Paper eqs. 10 to 12, with R u = u - V |u|: no neuron waits for a comparison.
inline Four fired(const Four& s, const Four& share, const Four& V) {
  const Four u = s * share;
  return V + (u - V * magnitude(u));
}

/// Groups of nodes whose inputs are summed before the first of them fires: what a group's neurons wait for
/// each other, the other groups fill.
inline constexpr std::size_t batch = 8;

template <std::size_t n> void fire_batch(const FiringGroup* group, std::size_t count, Quad* V) {
  Four sums[batch][n], v[batch][4]; // component by component, a lane for each node of a group
  for (std::size_t g = 0; g < count; ++g) {
    sum_sources<n>(group[g], V, sums[g]);
    take_outputs<n>(V, group[g].node, v[g]);
    for (std::size_t p = n; p < 4; ++p) v[g][p] = Four{};
  }
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t g = 0; g < count; ++g) {
      Four s = sums[g][p];
      for (std::size_t q = 0; q < n; ++q) s += fours(group[g].own[p])[q] * v[g][q];
      v[g][p] = fired(s, fours(group[g].share)[p], v[g][p]);
    }
  for (std::size_t g = 0; g < count; ++g) {
    transpose(v[g][0], v[g][1], v[g][2], v[g][3]);
    for (std::size_t k = 0; k < 4; ++k) fours(V)[group[g].node[k]] = v[g][k];
  }
}

template <std::size_t n> void sweep_over(const FiringGroup* group, std::size_t count, Quad* V) {
  for (; count > batch; group += batch, count -= batch) fire_batch<n>(group, batch, V);
  fire_batch<n>(group, count, V);
}

inline void sweep(std::size_t components, const FiringGroup* group, std::size_t count, Quad* V) {
  if (components == 3) return sweep_over<3>(group, count, V);
  if (components == 2) return sweep_over<2>(group, count, V);
  sweep_over<1>(group, count, V);
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
