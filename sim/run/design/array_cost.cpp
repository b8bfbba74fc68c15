#include "sim/run/design/array_cost.h"

#include "sim/files/output_file.h"
#include "sim/input/count_text.h"
#include "sim/levels/array_port.h"
#include "sim/machine/cost/part_synthesis.h"
#include "sim/machine/cost/placement.h"
#include "sim/machine/cost/whole_cost.h"
#include "sim/machine/rtl/rtl_cover.h"
#include "sim/run/design/rtl_design.h"
#include "sim/run/design/toggle_count.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <system_error>

namespace hopmesh::run {

namespace {

using input::grouped;
using machine::CostPoint, machine::Figure;
using Json = nlohmann::ordered_json;
using Rows = std::vector<pictures::Figure>;

std::string plain(double value) {
  if (value >= 1000) return grouped(static_cast<std::uint64_t>(std::llround(value)));
  return fmt::format("{:.4g}", value);
}

constexpr std::uint64_t counted_steps = 5; ///< the bits that change are those of the last one

/// What is known of an array: measured parts, NaN where there are none, beside what the model says.
struct Known {
  CostPoint measured, model;
  bool apart = false; ///< not folded

  bool has(Figure figure) const { return !std::isnan(whole_figure(measured, figure)); }
  double value(Figure figure) const { return whole_figure(has(figure) ? measured : model, figure); }
  const char* origin(Figure figure) const { return has(figure) ? "measured" : "model"; }
};

class Report {
 public:
  explicit Report(const Known& known) : known_(known) {}

  void begin(const std::string& title) { tables_.push_back({title, {}}); }
  void line(const std::string& name, const std::string& text) {
    tables_.back().second.push_back({name, text});
  }
  void add(const std::string& name, double value, const std::string& unit, const char* origin) {
    if (std::isnan(value)) return line(name, "not known");
    line(name, fmt::format("{}{}, {}", plain(value), unit.empty() ? "" : " " + unit, origin));
    json_["figures"].push_back({{"name", name}, {"value", value}, {"unit", unit}, {"origin", origin}});
  }
  /// Measured, where it is, with the model's beside it; else the model's, with its error.
  void add(const std::string& name, Figure figure, const std::string& unit, double scale = 1) {
    const double model = scale * whole_figure(known_.model, figure);
    const double error = machine::cost_model().largest_error(figure);
    if (!known_.has(figure)) {
      add(name, model, unit, "model");
      if (!std::isnan(model) && !std::isnan(error))
        tables_.back().second.back().value +=
            fmt::format(", within {:.0f} % where it was held to synthesis", 100 * error);
    } else {
      add(name, scale * known_.value(figure), unit, "measured");
      if (!std::isnan(model)) tables_.back().second.back().value += fmt::format(" (model {})", plain(model));
    }
    if (std::isnan(model)) return;
    json_["figures"].back()["model"] = model;
    if (!std::isnan(error)) json_["figures"].back()["model_error"] = error;
  }
  Json& json() { return json_; }
  std::vector<FigureTable>& tables() { return tables_; }

 private:
  const Known& known_;
  std::vector<FigureTable> tables_;
  Json json_;
};

void add_fpga(Report& report, const Known& known, const machine::MemoryBlocks& blocks) {
  report.begin("ECP5, cells of yosys");
  report.add("LUT4", Figure::ecp5_lut4, "");
  report.add("carry cells, each in the place of two LUT4", Figure::ecp5_carry, "");
  report.add("flip-flops", Figure::ecp5_ff, "");
  report.add("multipliers 18 x 18", Figure::ecp5_dsp, "");
  report.add("memories of 18 kbit", blocks.ecp5_blocks, "", "model");
  report.begin("iCE40, cells of yosys");
  report.add("LUT4 ", Figure::ice40_lut4, "");
  report.add("carries", Figure::ice40_carry, "");
  report.add("flip-flops ", Figure::ice40_ff, "");
  report.add("multipliers 16 x 16", Figure::ice40_dsp, "");
  report.add("memories of 4 kbit", blocks.ice40_blocks, "", "model");
  if (known.apart) report.line("links", "wires between neurons, which no figure has");
}

void add_silicon(Report& report, const Known& known, const machine::MemoryBlocks& blocks) {
  report.begin("OSU 0.18 um, cells without wires");
  report.add("logic", Figure::um2, "kGE", 1 / machine::um2_a_gate / 1000);
  report.add("logic, area", Figure::um2, "mm2", 1e-6);
  report.add("critical path", Figure::path_ns, "ns");
  report.line("memories",
              fmt::format("{} bits, and {} bits of tables", plain(blocks.bits), plain(blocks.table_bits)));
  report.add("memories, at 0.8 GE a bit", blocks.bits * machine::gates_a_bit / 1000, "kGE", "model");
  report.json()["memory_bits"] = blocks.bits;
  report.json()["table_bits"] = blocks.table_bits;
  static_cast<void>(known);
}

void add_energy(Report& report, const Known& known, const machine::Activity& activity,
                const machine::Toggles& toggles) {
  CostPoint parts = known.model;
  const bool weighed = known.has(Figure::active_pj);
  if (weighed) parts = known.measured;
  const machine::Energy ours = machine::silicon_energy(activity, parts, toggles);
  const machine::Energy table = machine::table_energy(activity, parts.parameters);
  const char* origin = "model";
  report.add("energy, 0.18 um and 1.8 V", 1e6 * ours.total(), "uJ", origin);
  report.add("  clocks", 1e6 * ours.clock, "uJ", origin);
  report.add("  elements and stages at work", 1e6 * ours.arithmetic, "uJ", origin);
  report.add("  memories", 1e6 * ours.memory, "uJ", origin);
  report.add("  bus", 1e6 * ours.bus, "uJ", origin);
  report.add("energy by the published table, 45 nm and 0.9 V", 1e6 * table.total(), "uJ", origin);
  report.line("bits that change at a multiplier",
              fmt::format("weights {:.0f} %, links {:.0f} %, counted over {} of the motion",
                          100 * toggles.weights, 100 * toggles.links,
                          input::with_noun(counted_steps, "step")));
  report.json()["toggles"] = {{"weights", toggles.weights}, {"links", toggles.links}};
  report.json()["energy_parts_weighed"] = weighed;
}

void add_step(Report& report, const Known& known, const levels::Prepared& p, const StepLoad& step) {
  const spec::ArraySpec& array = p.inputs.array;
  const spec::Topology& topology = p.mesh->topology();
  const machine::Work work = machine::work_of(array, topology, step.runs, step.sweeps, levels::longest_burst);
  const machine::Timeline time = machine::timeline_of(array, topology, work);
  report.begin("A step of " + input::with_noun(step.sweeps, "sweep"));
  report.add("time", 1e3 * time.time().seconds(array.clock_mhz), fmt::format("ms at {} MHz", array.clock_mhz),
             "model");
  add_energy(report, known, machine::activity_of(array, topology, work, step.runs),
             count_toggles(p, std::min<std::uint64_t>(
                                  counted_steps, static_cast<std::uint64_t>(p.inputs.scene.motion.steps))));
  report.add("utilisation", time.utilisation(), "", "model");
  report.add("utilisation with the bus", time.utilisation_with_bus(), "", "model");
}

/// A folder for tools: below `out`, or one that goes again.
class ToolFolder {
 public:
  explicit ToolFolder(const std::filesystem::path& out) : path_(out / "design"), goes_(out.empty()) {
    if (!goes_) return;
    std::string name = (std::filesystem::temp_directory_path() / "hopmesh-cost-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
  }
  ToolFolder(const ToolFolder&) = delete;
  ToolFolder& operator=(const ToolFolder&) = delete;
  ~ToolFolder() {
    std::error_code ignored;
    if (goes_) std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool goes_;
};

std::set<machine::Target> targets_of(const machine::CostTools& tools) {
  std::set<machine::Target> targets{machine::Target::ecp5, machine::Target::ice40};
  if (tools.weigh_silicon()) targets.insert(machine::Target::osu018);
  return targets;
}

void add_placement(Report& report, const machine::Placement& placed) {
  report.begin("Placed and routed, iCE40 " + placed.device + ", nextpnr");
  if (!placed.fits) {
    report.line("fits", "no: " + placed.why);
    report.json()["placement"] = {{"device", placed.device}, {"fits", false}, {"why", placed.why}};
    return;
  }
  std::vector<double> mhz = placed.mhz;
  std::sort(mhz.begin(), mhz.end());
  report.line("logic cells", fmt::format("{} of {}, measured", plain(placed.cells), plain(placed.of)));
  report.line("memories, multipliers",
              fmt::format("{} and {}, measured", placed.memories, placed.multipliers));
  report.add("clock, least of the seeds", mhz.front(), "MHz", "measured");
  report.line("seeds", fmt::format("{:.1f} MHz", fmt::join(mhz, " ")));
  report.json()["placement"] = {{"device", placed.device},
                                {"fits", true},
                                {"mhz", mhz},
                                {"cells", placed.cells},
                                {"of", placed.of},
                                {"memories", placed.memories},
                                {"multipliers", placed.multipliers},
                                {"without_dsp", placed.without_dsp}};
}

void tell_missing(const machine::CostTools& tools, std::vector<std::string>& notes) {
  const std::vector<std::string> missing = tools.missing();
  if (!missing.empty())
    notes.push_back(fmt::format("not installed: {}; the model stands in", fmt::join(missing, ", ")));
}

} // namespace

CostReport array_cost(const levels::Prepared& p, const CostOrder& order,
                      const std::function<void(const std::string&)>& tell) {
  const spec::ArraySpec& array = p.inputs.array;
  const spec::Topology& topology = p.mesh->topology();
  CostReport result;
  Known known;
  known.apart = !spec::is_folded(array);
  known.model = machine::cost_model().predict(machine::cost_parameters(array, topology));
  known.measured = known.model;
  known.measured.array = array.name;
  for (machine::PartFigures& part : known.measured.parts) part.fill(std::nan(""));
  std::optional<machine::Placement> placed;
  const auto fault = machine::rtl_fault(array, topology);
  const machine::CostTools tools = machine::find_cost_tools();
  if (order.measure && fault)
    result.notes.push_back(fmt::format("no RTL of this array, so the model stands in: {} is {}, expected {}",
                                       fault->key, fault->found, fault->expected));
  else if (order.measure)
    tell_missing(tools, result.notes);
  if (order.measure && !fault && !tools.yosys.empty()) {
    const ToolFolder folder(order.out);
    write_rtl_design(p, 0, folder.path());
    const machine::Synthesis synthesis =
        machine::synthesise_parts(folder.path(), tools, targets_of(tools), order.workers, tell);
    known.measured.parts = synthesis.parts;
    result.point = machine::points_text({known.measured});
    if (synthesis.without_dsp)
      result.notes.push_back("yosys died of synth_ice40 -dsp, so some part has no multipliers of iCE40");
    for (const std::string& name : synthesis.failed) result.notes.push_back("no figure: " + name);
    if (order.place && tools.place())
      placed = machine::place_on_ice40(folder.path(), tools, 3, order.workers, tell);
  }
  Report report(known);
  report.json()["scene"] = p.inputs.scene.name;
  report.json()["array"] = array.name;
  report.json()["figures"] = Json::array();
  const machine::MemoryBlocks blocks = machine::memory_blocks(machine::memories_of(array, topology));
  add_fpga(report, known, blocks);
  add_silicon(report, known, blocks);
  add_step(report, known, p, order.step);
  if (placed) add_placement(report, *placed);
  result.tables = report.tables();
  report.json()["notes"] = result.notes;
  result.json = report.json().dump(2) + "\n";
  if (!order.out.empty()) {
    std::filesystem::create_directories(order.out);
    files::write_file(order.out / "cost.json", result.json);
  }
  return result;
}

FigureTable cost_table(const spec::ArraySpec& array, const spec::Topology& topology, const StepLoad& step) {
  Known known;
  known.apart = !spec::is_folded(array);
  known.model = machine::cost_model().predict(machine::cost_parameters(array, topology));
  known.measured = known.model;
  for (machine::PartFigures& part : known.measured.parts) part.fill(std::nan(""));
  Report report(known);
  const machine::Work work = machine::work_of(array, topology, step.runs, step.sweeps, levels::longest_burst);
  report.begin("Cost, by the fitted model");
  report.add("LUT4 of ECP5", Figure::ecp5_lut4, "");
  report.add("logic in OSU 0.18 um", Figure::um2, "kGE", 1 / machine::um2_a_gate / 1000);
  report.add("memories", machine::memory_kge(array, topology), "kGE", "model");
  report.add("energy of the step", 1e6 * machine::energy_joule(array, topology, work, step.runs), "uJ",
             "model");
  return report.tables().front();
}

} // namespace hopmesh::run
