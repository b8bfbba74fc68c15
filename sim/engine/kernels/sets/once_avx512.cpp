// Kernels for weights kept once, for processors with AVX-512.
#include "sim/engine/kernels/kernel_pack.h"
#include "sim/engine/kernels/sets/avx512.h"

namespace hopmesh::engine {

const OnceKernels avx512_once = once_of<Avx512>();

} // namespace hopmesh::engine
