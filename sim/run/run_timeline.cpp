#include "sim/run/run_timeline.h"

#include "sim/input/count_text.h"
#include "sim/levels/array_port.h"
#include "sim/machine/timeline_picture.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::run {

std::string host_text(const scene::HostSpec& host) {
  return fmt::format("host {} at {:g} MHz, cycles an instruction: {:g}", name_of(host.core), host.clock_mhz,
                     host.cpi);
}

machine::Timeline timeline_of_run(const RunFacts& facts, const levels::BuiltMesh& mesh, const StepLog& rows) {
  const auto sum = [&](std::uint64_t levels::StepRow::*figure) {
    return count_of(rows, figure, levels::Summary::sum);
  };
  const scene::HostSpec& host = facts.inputs.scene.host;
  return machine::timeline_of(
      facts.inputs.array, mesh.topology(),
      {sum(&levels::StepRow::cycles), sum(&levels::StepRow::bus_cycles), sum(&levels::StepRow::sweeps),
       host.known_seconds(total_of(rows, &levels::StepRow::instructions, levels::Summary::sum))});
}

const levels::StepRow* typical_step(const StepLog& rows) {
  std::vector<const levels::StepRow*> all;
  for (const levels::StepRow& row : rows.kept()) all.push_back(&row);
  if (all.empty()) return nullptr;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(), [](const levels::StepRow* a, const levels::StepRow* b) {
    return std::pair(a->sweeps, a->step) < std::pair(b->sweeps, b->step);
  });
  return *middle;
}

pictures::Drawing timeline_drawing(const RunFacts& facts, const levels::BuiltMesh& mesh,
                                   const StepLog& rows) {
  const spec::ArraySpec& array = facts.inputs.array;
  const spec::Topology& t = mesh.topology();
  machine::TimelineView view;
  view.title = "Who works when";
  const scene::HostSpec& host = facts.inputs.scene.host;
  view.note = fmt::format("array {} at {} MHz, as counted; {}", array.name, array.clock_mhz,
                          host.counts() ? host_text(host) : "the host's own part is not known");
  view.runs = typical_load(facts, rows).runs;
  view.read = view.runs * machine::run_transfers(array, t, levels::longest_burst).read;
  view.clock_mhz = array.clock_mhz;
  if (const levels::StepRow* row = typical_step(rows)) {
    view.step = machine::timeline_of(
        array, t,
        {row->cycles, row->bus_cycles, row->sweeps, host.known_seconds(row->instructions.value_or(0))});
    view.step_name =
        fmt::format("Step {}, the one in the middle: {}", row->step, input::with_noun(row->sweeps, "sweep"));
  }
  view.motion = timeline_of_run(facts, mesh, rows);
  view.motion_name = "All " + input::with_noun(rows.size(), "step");
  return {"Time on hardware", machine::svg_of(view)};
}

StepLoad typical_load(const RunFacts& facts, const StepLog& rows) {
  StepLoad load = longest_step(facts.inputs.scene);
  if (const levels::StepRow* row = typical_step(rows)) load.sweeps = row->sweeps;
  return load;
}

} // namespace hopmesh::run
