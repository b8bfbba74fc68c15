// The error that ends a command whose files cannot be written, for those who write none themselves.
#pragma once

#include "sim/files/output_file.h"

namespace hopmesh::run {

using files::WriteError;

} // namespace hopmesh::run
