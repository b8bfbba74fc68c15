// The loops of the fast twin for processors with AVX2.
#include "sim/reference/block_kernel_body.h"

namespace hopmesh::reference {

const BlockKernel avx2_kernel{"avx2", inputs, sweep, turn, bend, walk};

} // namespace hopmesh::reference
