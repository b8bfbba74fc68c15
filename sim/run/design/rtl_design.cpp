#include "sim/run/design/rtl_design.h"

#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/levels/level.h"
#include "sim/machine/rtl/rtl_cover.h"
#include "sim/machine/rtl/rtl_sources.h"
#include "sim/machine/rtl/rtl_text.h"
#include "sim/run/design/bus_script.h"

#include <fmt/format.h>

namespace hopmesh::run {

namespace {

void refuse_what_is_not_covered(const spec::ArraySpec& array, const spec::Topology& topology) {
  if (const auto fault = machine::rtl_fault(array, topology))
    throw input::input_error("", 0, fault->key, fault->found, fault->expected);
}

class DesignWriter {
 public:
  explicit DesignWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void file(const std::string& name, const std::string& text) {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    files::write_file(path, text);
    written_ += 1;
  }
  std::size_t written() const { return written_; }

 private:
  const std::filesystem::path folder_;
  std::size_t written_ = 0;
};

} // namespace

DesignFacts write_rtl_design(const levels::Prepared& p, std::size_t steps,
                             const std::filesystem::path& folder) {
  const spec::ArraySpec& array = p.inputs.array;
  const spec::Topology topology = p.mesh->topology();
  refuse_what_is_not_covered(array, topology);
  const auto port = levels::default_level().make_port(array, topology, {});
  BusScript script(*port);
  levels::ArrayMover mover(p.inputs.scene, *p.mesh, array, script, false);
  DesignFacts facts;
  for (std::size_t k = 0; k < steps; ++k) facts.cycles.push_back(mover.advance().cycles);
  DesignWriter to(folder);
  for (const auto& [name, text] : machine::rtl_sources())
    if (machine::is_rtl_module(name) || name == "hm_register_map.vh" || name == "hopmesh.core")
      to.file("rtl/" + name, text);
  for (const machine::BitTable& table :
       machine::rtl_tables(array, topology, machine::rtl_room(array, topology)))
    to.file(machine::rtl_table_file(table), table.hex());
  to.file("hopmesh_top.v", machine::rtl_top_text(array, topology));
  to.file("hopmesh_axi_top.v", machine::rtl_axi_text());
  to.file("hopmesh.f", fmt::format("{}\n", fmt::join(machine::rtl_files(), "\n")));
  to.file("ice40.ys", machine::yosys_text("ice40", "hopmesh_axi_top"));
  to.file("ecp5.ys", machine::yosys_text("ecp5", "hopmesh_axi_top"));
  for (const std::string name : {"hopmesh_test.v", "hopmesh_axi_test.v"})
    to.file("test/" + name, machine::rtl_source(name));
  to.file("test/script.hex", script.hex());
  to.file("test/hopmesh_script.vh", fmt::format("localparam SCRIPT_LINES = {};\n", script.lines()));
  to.file("README.md", machine::rtl_readme_text(array, topology, p.inputs.scene.name, steps));
  facts.files = to.written();
  facts.lines = script.lines();
  return facts;
}

} // namespace hopmesh::run
