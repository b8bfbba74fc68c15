// What a bench needs to know of a folder of memories, so that it parses nothing: parameters, memories, a
// page.
#pragma once

#include "sim/cosim/firings/firing_files.h"

namespace hopmesh::cosim {

/// Parameters in Verilog: the array's keys, the count and width of every memory, the bits of the edges.
std::string layout_text(const NeuronShape& shape, const std::string& name, std::size_t firings);
/// Declares every memory, and the task `read_neurons` that reads those that are there; in a blank folder,
/// answers are only declared.
std::string memories_text(bool blank);
/// README.md of the folder: what lies in it, and how a bench reads it.
std::string folder_page(const NeuronShape& shape, const FiringTask& task, std::size_t firings);

} // namespace hopmesh::cosim
