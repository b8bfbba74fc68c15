// The files of a design that depend on array and network: its top modules, and what tools are told.
#pragma once

#include "sim/machine/rtl/rtl_tables.h"

namespace hopmesh::machine {

/// hopmesh_top: hm_device with its parameters and facts, tables from the folder `tables`.
std::string rtl_top_text(const spec::ArraySpec& array, const spec::Topology& topology);
/// hopmesh_axi_top: the same behind AXI4-Lite.
std::string rtl_axi_text();
/// The name of a table's file.
std::string rtl_table_file(const BitTable& table);
/// Names of all Verilog files of a design, from its folder.
std::vector<std::string> rtl_files();
/// A script for yosys: `family` as in synth_FAMILY, `top` the module.
std::string yosys_text(const std::string& family, const std::string& top);
/// Of a design: `scene` whose mesh it is for, and how many steps its test bench plays.
std::string rtl_readme_text(const spec::ArraySpec& array, const spec::Topology& topology,
                            const std::string& scene, std::size_t steps);

} // namespace hopmesh::machine
