#include "sim/cosim/explain.h"

#include "rtl_model/spec/schedule.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

FirstDifference in_mesh(const Divergence& d, const levels::BuiltMesh& mesh, const ArrayJob& job) {
  const auto n = static_cast<std::uint32_t>(mesh.components());
  FirstDifference f;
  f.sweep = d.sweep, f.cycle = d.cycle;
  f.sweep_cycles = Timing(job).cycles.sweep;
  f.cell = d.neuron / n, f.component = d.neuron % n;
  f.node = mesh.node_of_cell(f.cell);
  f.raw[0] = d.raw[0], f.raw[1] = d.raw[1];
  f.before_raw = d.before_raw, f.bias_raw = d.bias_raw, f.ahead = d.ahead;
  for (const Tap& tap : d.taps)
    f.inputs.push_back({mesh.node_of_cell(tap.cell), tap.component, tap.weight_raw, tap.output_raw});
  return f;
}

std::optional<FirstDifference> first_difference(const Arrays& two, const levels::BuiltMesh& mesh,
                                                const ArrayJob& job, std::uint32_t sweeps) {
  auto where = run_in_lockstep(two, job, sweeps).where;
  if (!where) where = part_from_start(two, job, sweeps);
  if (!where) return std::nullopt;
  return in_mesh(*where, mesh, job);
}

std::string text_of(const FirstDifference& w, const std::string& a, const std::string& b) {
  std::string text =
      fmt::format("  sweep {}, cycle {} of the run, node {}, neuron {}: V {} -> {} ({}) or {} ({})\n",
                  w.sweep, w.cycle, w.node, w.component, w.before_raw, w.raw[0], a, w.raw[1], b);
  text += fmt::format("  its inputs one update earlier, bias {}{}:\n", w.bias_raw, ahead_note(w.ahead));
  for (const NeuronInput& in : w.inputs)
    text += fmt::format("    node {:>6} neuron {}  weight {:>11}  V {:>11}\n", in.node, in.component,
                        in.weight_raw, in.output_raw);
  return text;
}

} // namespace hopmesh::cosim
