// Kernels for processors with AVX-512.
#include "sim/engine/kernels/kernel_ahead.h"
#include "sim/engine/kernels/sets/avx512.h"

namespace hopmesh::engine {

const KernelSet avx512_kernels = kernels_of<Avx512>("avx512", &avx512_once);

} // namespace hopmesh::engine
