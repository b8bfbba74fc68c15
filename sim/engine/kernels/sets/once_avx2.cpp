// Kernels for weights kept once, for processors with AVX2.
#include "sim/engine/kernels/kernel_pack.h"
#include "sim/engine/kernels/sets/avx2.h"

namespace hopmesh::engine {

const OnceKernels avx2_once = once_of<Avx2>();

} // namespace hopmesh::engine
