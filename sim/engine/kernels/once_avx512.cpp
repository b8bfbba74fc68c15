// Kernels for weights kept once, for processors with AVX-512.
#include "sim/engine/kernels/avx512.h"
#include "sim/engine/kernels/kernel_pack.h"

namespace hopmesh::engine {

const OnceKernels avx512_once = once_of<Avx512>();

} // namespace hopmesh::engine
