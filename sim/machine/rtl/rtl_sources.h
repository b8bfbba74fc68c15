// The files of rtl_model/verilog, which live in the program: so a design, and a model of it, can be made
// wherever the program is.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hopmesh::machine {

/// Names and texts: the modules, the register map that they include, the test bench, the face of a model.
const std::vector<std::pair<std::string, std::string>>& rtl_sources();
const std::string& rtl_source(const std::string& name);
/// Is it a module of the design?
bool is_rtl_module(const std::string& name);

} // namespace hopmesh::machine
