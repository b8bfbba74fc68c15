// The loops of a force pass for processors with AVX2.
#include "sim/rivals/force_kernel_body.h"

namespace hopmesh::rivals {

const ForceKernel avx2_kernel{"avx2", pull_block, kick_all};

} // namespace hopmesh::rivals
