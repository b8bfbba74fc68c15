// The loops of a force pass for processors with AVX-512.
#include "sim/rivals/force_kernel_body.h"

namespace hopmesh::rivals {

const ForceKernel avx512_kernel{"avx512", pull_block, kick_all};

} // namespace hopmesh::rivals
