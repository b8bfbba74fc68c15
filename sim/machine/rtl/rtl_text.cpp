#include "sim/machine/rtl/rtl_text.h"

#include "sim/machine/rtl/rtl_sources.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::machine {

namespace {

struct Port {
  const char *direction, *name;
  int bits;
};

constexpr Port bus_ports[] = {
    {"input", "request", 1},     {"input", "write", 1},       {"input", "address", 32},
    {"input", "bytes", 32},      {"input", "write_data", 32}, {"output", "ready", 1},
    {"output", "beat", 1},       {"output", "last", 1},       {"output", "answer", 2},
    {"output", "read_valid", 1}, {"output", "read_data", 32}, {"output", "irq", 1}};
constexpr Port axi_ports[] = {{"input", "awvalid", 1}, {"output", "awready", 1}, {"input", "awaddr", 32},
                              {"input", "wvalid", 1},  {"output", "wready", 1},  {"input", "wdata", 32},
                              {"input", "wstrb", 4},   {"output", "bvalid", 1},  {"input", "bready", 1},
                              {"output", "bresp", 2},  {"input", "arvalid", 1},  {"output", "arready", 1},
                              {"input", "araddr", 32}, {"output", "rvalid", 1},  {"input", "rready", 1},
                              {"output", "rdata", 32}, {"output", "rresp", 2}};

std::string declared(const Port& port) {
  const std::string range = port.bits == 1 ? "" : fmt::format("[{}:0] ", port.bits - 1);
  return fmt::format("{:<6} wire {}{}", port.direction, range, port.name);
}

std::string connected(const char* name) {
  return fmt::format("      .{0}({0})", name);
}

template <typename Lines> std::string with_commas(const Lines& lines) {
  return fmt::format("{}", fmt::join(lines, ",\n"));
}

} // namespace

std::string rtl_table_file(const BitTable& table) {
  std::string name = table.name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c == '_' ? '_' : char(c | 32); });
  return "tables/" + name + ".hex";
}

std::string rtl_top_text(const spec::ArraySpec& array, const spec::Topology& topology) {
  const RtlRoom room = rtl_room(array, topology);
  std::vector<std::string> ports{"    input  wire clock"}, parameters, facts, wires{connected("clock")};
  for (const Port& port : bus_ports) {
    ports.push_back("    " + declared(port));
    wires.push_back(connected(port.name));
  }
  for (const RtlParameter& p : rtl_parameters(array, room))
    parameters.push_back(fmt::format("      .{}({})", p.name, p.value));
  for (const BitTable& table : rtl_tables(array, topology, room))
    parameters.push_back(fmt::format("      .{}_FILE(\"{}\")", table.name, rtl_table_file(table)));
  for (std::uint32_t word : rtl_facts(array, topology)) facts.push_back(fmt::format("    32'h{:08x}", word));
  const std::size_t count = facts.size();
  std::reverse(facts.begin(), facts.end());
  wires.push_back("      .facts(FACTS)");
  // Whether it works is a register, too.
  wires.push_back("      .busy()");
  return fmt::format(
      "// The array \"{}\" for a network of {} cells. Made by hopmesh rtl.\nmodule hopmesh_top (\n{}\n);\n"
      "  // As hm_device wants them, the last one first.\n  localparam [{}:0] FACTS = {{\n{}\n  }};\n"
      "  // verilator lint_off PINCONNECTEMPTY\n  hm_device #(\n{}\n  ) device (\n{}\n  );\n"
      "  // verilator lint_on PINCONNECTEMPTY\nendmodule\n",
      array.name, topology.cells(), with_commas(ports), 32 * count - 1, with_commas(facts),
      with_commas(parameters), with_commas(wires));
}

std::string rtl_axi_text() {
  std::vector<std::string> ports{"    input  wire clock", "    input  wire reset_n"},
      face{connected("clock"), connected("reset_n")}, device{connected("clock")};
  std::string wires;
  for (const Port& port : axi_ports) {
    ports.push_back("    " + declared(port));
    face.push_back(connected(port.name));
  }
  ports.push_back("    output wire irq");
  for (const Port& port : bus_ports) {
    const std::string name = port.name;
    device.push_back(connected(port.name));
    if (name == "irq") continue;
    const std::string range = port.bits == 1 ? "" : fmt::format("[{}:0] ", port.bits - 1);
    wires += fmt::format("  wire {}{};\n", range, name);
    if (name != "beat") face.push_back(connected(port.name));
  }
  return fmt::format(
      "// The array behind AXI4-Lite. Made by hopmesh rtl.\nmodule hopmesh_axi_top (\n{}\n);\n"
      "  // verilator lint_off UNUSED\n{}  // verilator lint_on UNUSED\n  hm_axi_lite face (\n{}\n  );\n"
      "  hopmesh_top array (\n{}\n  );\nendmodule\n",
      with_commas(ports), wires, with_commas(face), with_commas(device));
}

std::vector<std::string> rtl_files() {
  std::vector<std::string> files;
  for (const auto& [name, text] : rtl_sources())
    if (is_rtl_module(name)) files.push_back("rtl/" + name);
  files.push_back("hopmesh_top.v");
  files.push_back("hopmesh_axi_top.v");
  return files;
}

std::string yosys_text(const std::string& family, const std::string& top) {
  std::string text = "# yosys -s " + family + ".ys\n";
  for (const std::string& file : rtl_files()) text += "read_verilog -sv -Irtl " + file + "\n";
  return text +
         fmt::format("synth_{0} -top {1} -json {0}.json\ncheck -assert\ntee -o {0}.txt stat\n", family, top);
}

std::string rtl_readme_text(const spec::ArraySpec& array, const spec::Topology& topology,
                            const std::string& scene, std::size_t steps) {
  return fmt::format(
      "# The array \"{0}\" for the scene \"{1}\", in Verilog\n\n"
      "Made by `hopmesh rtl`. {2} cells of {3} neurons on {4} elements. All commands are for this folder.\n\n"
      "| file | content |\n|---|---|\n"
      "| `hopmesh_top.v` | the array on its native bus (`rtl/hm_device.v` says how it works) |\n"
      "| `hopmesh_axi_top.v` | the same behind AXI4-Lite |\n"
      "| `rtl/` | the modules, the same for every array; `hm_register_map.vh` has the addresses of registers "
      "|\n"
      "| `tables/` | what makes it the array of this network; `$readmemh` reads them |\n"
      "| `hopmesh.f` | the list of files |\n"
      "| `test/` | a test bench and its script: the first {5} steps of the motion as they went over the bus "
      "of "
      "another model, every word that was read with its value |\n"
      "| `ice40.ys`, `ecp5.ys` | synthesis by yosys |\n\n"
      "```sh\n"
      "iverilog -g2012 -Irtl -Itest -f hopmesh.f -o hopmesh.vvp test/hopmesh_test.v && vvp -n hopmesh.vvp\n"
      "iverilog -g2012 -Irtl -f hopmesh.f -o axi.vvp test/hopmesh_axi_test.v && vvp -n axi.vvp\n"
      "verilator --binary --timing -Wno-fatal -Irtl -Itest -f hopmesh.f --top-module hopmesh_test "
      "test/hopmesh_test.v && obj_dir/Vhopmesh_test\n"
      "yosys -q -s ecp5.ys\n"
      "```\n\n"
      "Both simulators print `PASSED`, or `FAILED` and the first wrong words.\n",
      array.name, scene, topology.cells(), topology.neurons_per_cell, array.elements, steps);
}

} // namespace hopmesh::machine
