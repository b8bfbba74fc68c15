// Kernels for processors with AVX2.
#include "sim/engine/kernels/kernel_ahead.h"
#include "sim/engine/kernels/sets/avx2.h"

namespace hopmesh::engine {

const KernelSet avx2_kernels = kernels_of<Avx2>("avx2", &avx2_once);

} // namespace hopmesh::engine
