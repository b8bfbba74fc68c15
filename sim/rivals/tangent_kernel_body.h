// The loops over springs about a place (force_kernel.h), included once for each instruction set.
#include "sim/rivals/force_kernel_body.h"

namespace hopmesh::rivals {
namespace {

/// Scratch on the stack, as Pulls.
struct Moments {
  alignas(64) double component[6][block_size]; ///< xx, yy, zz, xy, xz, yz

  void fill(const Block& block, const Tangents& t) {
    for (std::ptrdiff_t s = 0; s < block.count; ++s) {
      component[0][s] = t.sideways[s] + t.x[s] * t.x[s];
      component[1][s] = t.sideways[s] + t.y[s] * t.y[s];
      component[2][s] = t.sideways[s] + t.z[s] * t.z[s];
      component[3][s] = t.x[s] * t.y[s];
      component[4][s] = t.x[s] * t.z[s];
      component[5][s] = t.y[s] * t.z[s];
    }
  }
};

inline void linearise_block(const Block& block, std::ptrdiff_t nodes, const double* position,
                            const Tangents& t, double* diagonal) {
  double* const span[3] = {t.x, t.y, t.z};
  for (std::ptrdiff_t p = 0; p < 3; ++p) read_spans(block, position + p * nodes, span[p]);
#pragma omp simd
  for (std::ptrdiff_t s = 0; s < block.count; ++s) {
    const double root = std::sqrt(t.x[s] * t.x[s] + t.y[s] * t.y[s] + t.z[s] * t.z[s]);
    const double length = root > shortest_spring ? root : shortest_spring, ratio = block.rest[s] / length;
    const double more = block.stiffness[s] * (ratio < 1 ? ratio : 1), along = std::sqrt(more) / length;
    t.sideways[s] = block.stiffness[s] - more;
    t.x[s] *= along;
    t.y[s] *= along;
    t.z[s] *= along;
  }
  Moments moments;
  moments.fill(block, t);
  for (std::ptrdiff_t c = 0; c < 6; ++c) add_to_ends<1>(block, moments.component[c], diagonal + c * nodes);
}

// As pull_wide_row.
inline void multiply_wide_row(const Block& row, const Tangents& t, std::ptrdiff_t nodes, const double* x,
                              double* q) {
  const double *const y = x + nodes, *const z = y + nodes;
  double *const qy = q + nodes, *const qz = qy + nodes;
  const std::ptrdiff_t count = row.count, apart = row.distance;
  const double *const side = t.sideways, *const ux = t.x, *const uy = t.y, *const uz = t.z;
#pragma omp simd safelen(8)
  for (std::ptrdiff_t s = 0; s < count; ++s) {
    const double dx = x[s + apart] - x[s], dy = y[s + apart] - y[s], dz = z[s + apart] - z[s];
    const double along = ux[s] * dx + uy[s] * dy + uz[s] * dz;
    const double px = side[s] * dx + along * ux[s], py = side[s] * dy + along * uy[s],
                 pz = side[s] * dz + along * uz[s];
    q[s] -= px;
    qy[s] -= py;
    qz[s] -= pz;
    q[s + apart] += px;
    qy[s + apart] += py;
    qz[s + apart] += pz;
  }
}

inline void multiply_narrow(const Block& block, const Tangents& t, std::ptrdiff_t nodes, const double* vector,
                            double* product) {
  Pulls pulls;
  for (std::ptrdiff_t p = 0; p < 3; ++p) read_spans(block, vector + p * nodes, pulls.component[p]);
  for (std::ptrdiff_t s = 0; s < block.count; ++s) {
    double &x = pulls.component[0][s], &y = pulls.component[1][s], &z = pulls.component[2][s];
    const double along = t.x[s] * x + t.y[s] * y + t.z[s] * z;
    x = -(t.sideways[s] * x + along * t.x[s]);
    y = -(t.sideways[s] * y + along * t.y[s]);
    z = -(t.sideways[s] * z + along * t.z[s]);
  }
  for (std::ptrdiff_t p = 0; p < 3; ++p) add_to_ends<-1>(block, pulls.component[p], product + p * nodes);
}

inline void multiply_block(const Block& block, const Tangents& tangents, std::ptrdiff_t nodes,
                           const double* vector, double* product) {
  if (is_wide(block))
    multiply_wide_row(block, tangents, nodes, vector + block.node, product + block.node);
  else
    multiply_narrow(block, tangents, nodes, vector, product);
}

} // namespace
} // namespace hopmesh::rivals
