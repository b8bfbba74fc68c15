#include "sim/run/machine_info.h"

#include "sim/files/output_file.h"
#include "sim/input/count_text.h"
#include "sim/levels/array_port.h"
#include "sim/machine/machine_picture.h"
#include "sim/machine/silicon.h"

#include <fmt/format.h>

namespace hopmesh::run {

namespace {

using input::grouped, input::with_noun;

std::string kib(std::uint64_t bits) {
  if (bits < 8192) return grouped(bits) + " bits";
  return fmt::format("{:.1f} KiB", static_cast<double>(bits) / 8192);
}

/// Only what there is: an array without reciprocals has no row of them.
void add_kib(const char* name, std::uint64_t bits, std::vector<pictures::Figure>& rows) {
  if (bits > 0) rows.push_back({name, kib(bits)});
}

std::string copies_text(const machine::Parts& parts) {
  std::string text;
  if (parts.link_memories > 1) text = ", " + with_noun(parts.link_memories, "time");
  return parts.link_banks > 1 ? text + ", in two banks" : text;
}

} // namespace

StepLoad longest_step(const scene::Scene& scene) {
  const auto runs = static_cast<std::uint64_t>(scene.relax.expansions);
  return {runs, runs * static_cast<std::uint64_t>(scene.relax.max_sweeps)};
}

FigureTable step_time_table(const spec::ArraySpec& array, const spec::Topology& topology,
                            const StepLoad& step) {
  const machine::RunTransfers bus = machine::run_transfers(array, topology, levels::longest_burst);
  const machine::Timeline t = machine::timeline_of(
      array, topology, machine::work_of(array, topology, step.runs, step.sweeps, levels::longest_burst));
  const machine::HardwareTime time = t.time();
  const auto row = [&](const char* name, std::uint64_t cycles) -> pictures::Figure {
    const double part = 100 * static_cast<double>(cycles) / static_cast<double>(time.cycles());
    return {name, fmt::format("{} cycles, {:.3g} %", grouped(cycles), part)};
  };
  std::string title = "A step of " + with_noun(step.sweeps, "sweep");
  if (step.runs > 1) title += fmt::format(" in {} runs", grouped(step.runs));
  return {title,
          {row("bus: load, start", step.runs * bus.load),
           row("array: START, prepare", t.prepare),
           row("array: sweeps", t.sweeps),
           row("bus: read back", step.runs * bus.read),
           {"bus and array together", fmt::format("{} cycles, {:.3g} ms at {} MHz", grouped(time.cycles()),
                                                  1e3 * time.seconds(array.clock_mhz), array.clock_mhz)},
           {"host, bus and array idle", "a run tells it, where the host counts (host.processor)"},
           {"utilisation", utilisation_text(t)}}};
}

FigureTable memory_table(const spec::ArraySpec& array, const spec::Topology& topology) {
  const machine::MemoryBits bits = machine::memory_bits(array, topology);
  std::vector<pictures::Figure> rows{
      {"weights", kib(bits.weights)},
      {"biases", kib(bits.biases)},
      {spec::has_momentum(array) ? "states, V and Y" : "states", kib(bits.states)},
      {"links", kib(bits.links) + copies_text(machine::parts_of(array, topology))}};
  add_kib("norms", bits.norms, rows);
  add_kib("reciprocals", bits.reciprocals, rows);
  add_kib("table of m", bits.momentum, rows);
  rows.push_back({"accumulators", kib(bits.sums)});
  rows.push_back({"all", grouped(bits.total()) + " bits"});
  return {"Memory", rows};
}

FigureTable multiplier_table(const spec::ArraySpec& array, const spec::Topology& topology) {
  const machine::MultiplierBits bits = machine::multiplier_bits(array, topology);
  FigureTable table{"Multipliers, width times width", {}};
  auto& rows = table.second;
  rows.push_back({"w L of the sums", grouped(bits.sums) + " bits"});
  if (bits.outputs > 0)
    rows.push_back({spec::has_momentum(array) ? "m ΔV" : "R u", grouped(bits.outputs) + " bits"});
  if (bits.normalisers > 0) rows.push_back({"s r", grouped(bits.normalisers) + " bits"});
  rows.push_back({"all multipliers", grouped(bits.total()) + " bits"});
  if (const std::uint64_t divider = machine::divider_bits(array, topology))
    rows.push_back({"subtractors of dividers", grouped(divider) + " bits"});
  return table;
}

void write_machine_picture(const spec::ArraySpec& array, const spec::Topology& topology,
                           const std::string& scene, const std::string& file) {
  files::write_file(file, machine::machine_picture(array, topology, scene));
}

std::string utilisation_text(const machine::Timeline& timeline) {
  return fmt::format("{:.3g} % of the array's cycles, {:.3g} % of array and bus",
                     100 * timeline.utilisation(), 100 * timeline.utilisation_with_bus());
}

} // namespace hopmesh::run
