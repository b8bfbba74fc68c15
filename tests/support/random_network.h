// The random networks of sim/cosim beside the slow array that judges them.
#pragma once

#include "sim/cosim/random_job.h"
#include "tests/support/slow_array.h"

namespace hopmesh::tests {
using namespace cosim;
} // namespace hopmesh::tests
