// The loops of the fast twin for every processor, and the choice between them.
#include "sim/reference/block_kernel_body.h"

namespace hopmesh::reference {

const BlockKernel portable_kernel{"portable", inputs, sweep, turn, bend, walk};

const BlockKernel& block_kernel() {
#ifdef HOPMESH_X86_KERNELS
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  if (wide && __builtin_cpu_supports("avx512vl")) return avx512_kernel;
  if (__builtin_cpu_supports("avx2")) return avx2_kernel;
#endif
  return portable_kernel;
}

} // namespace hopmesh::reference
