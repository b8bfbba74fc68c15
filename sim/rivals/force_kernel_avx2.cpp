// The loops over springs for processors with AVX2.
#include "sim/rivals/force_kernel_body.h"
#include "sim/rivals/tangent_kernel_body.h"

namespace hopmesh::rivals {

const ForceKernel avx2_kernel{"avx2", pull_block, kick_all, linearise_block, multiply_block};

} // namespace hopmesh::rivals
