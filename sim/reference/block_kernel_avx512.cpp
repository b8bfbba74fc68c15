// The loops of the fast twin for processors with AVX-512.
#include "sim/reference/block_kernel_body.h"

namespace hopmesh::reference {

const BlockKernel avx512_kernel{"avx512", inputs, sweep, turn, bend, walk};

} // namespace hopmesh::reference
