// The loops over springs for processors with AVX-512.
#include "sim/rivals/force_kernel_body.h"
#include "sim/rivals/tangent_kernel_body.h"

namespace hopmesh::rivals {

const ForceKernel avx512_kernel{"avx512", pull_block, kick_all, linearise_block, multiply_block};

} // namespace hopmesh::rivals
