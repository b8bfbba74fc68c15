// The loops over springs for every processor, and the choice between them.
#include "sim/rivals/force_kernel_body.h"
#include "sim/rivals/tangent_kernel_body.h"

namespace hopmesh::rivals {

const ForceKernel portable_kernel{"portable", pull_block, kick_all, linearise_block, multiply_block};

std::vector<ForceKernel> force_kernels() {
  std::vector<ForceKernel> all{portable_kernel};
#ifdef HOPMESH_X86_KERNELS
  if (__builtin_cpu_supports("avx2")) all.push_back(avx2_kernel);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl")) all.push_back(avx512_kernel);
#endif
  return all;
}

} // namespace hopmesh::rivals
