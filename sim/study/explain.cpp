#include "sim/study/explain.h"

#include "firmware/registers.h"
#include "rtl_model/spec/schedule.h"

#include <stdexcept>

namespace hopmesh::study {

namespace {

using Codes = std::vector<std::int32_t>;

constexpr std::size_t burst_words = 4096;

void must(int error) {
  if (error != HM_OK) throw std::runtime_error(error_text(error));
}

Codes read_window(const hm_bus& bus, std::uint32_t base, std::size_t count) {
  Codes codes(count);
  for (std::size_t done = 0; done < count; done += burst_words)
    must(bus.read_burst(bus.context, base + static_cast<std::uint32_t>(4 * done),
                        reinterpret_cast<std::uint32_t*>(codes.data() + done),
                        static_cast<std::uint32_t>(std::min(burst_words, count - done))));
  return codes;
}

void write_window(const hm_bus& bus, std::uint32_t base, const Codes& codes) {
  for (std::size_t done = 0; done < codes.size(); done += burst_words)
    must(bus.write_burst(bus.context, base + static_cast<std::uint32_t>(4 * done),
                         reinterpret_cast<const std::uint32_t*>(codes.data() + done),
                         static_cast<std::uint32_t>(std::min(burst_words, codes.size() - done))));
}

// V after exactly `sweeps` sweeps from the start.
Codes after_sweeps(const hm_bus& bus, const LoadedNetwork& network, std::uint32_t sweeps) {
  write_window(bus, HM_WINDOW_WEIGHT, network.weight);
  write_window(bus, HM_WINDOW_BIAS, network.bias);
  write_window(bus, HM_WINDOW_OUTPUT, network.start);
  if (sweeps == 0) return network.start;
  must(bus.write(bus.context, HM_REG_THRESHOLD, network.threshold));
  must(bus.write(bus.context, HM_REG_MAX_SWEEPS, sweeps));
  must(bus.write(bus.context, HM_REG_IRQ_ENABLE, HM_IRQ_DONE));
  must(bus.write(bus.context, HM_REG_CONTROL, HM_CONTROL_START));
  must(bus.wait(bus.context));
  must(bus.write(bus.context, HM_REG_IRQ_STATUS, HM_IRQ_DONE));
  return read_window(bus, HM_WINDOW_OUTPUT, network.start.size());
}

// Outputs in the middle of a sweep: phases before k have fired, the others have not.
Codes in_sweep(const spec::Phases& phases, std::size_t k, const Codes& before, const Codes& after) {
  Codes now = before;
  for (std::size_t earlier = 0; earlier < k; ++earlier)
    for (std::uint32_t neuron : phases[earlier]) now[neuron] = after[neuron];
  return now;
}

std::vector<NeuronInput> inputs_of(std::uint32_t neuron, const BuiltMesh& mesh, const LoadedNetwork& network,
                                   const Codes& outputs) {
  const spec::Topology& t = mesh.topology();
  const std::size_t n = mesh.components(), cell = neuron / n, row = t.row_offset(cell, neuron % n);
  std::vector<NeuronInput> inputs;
  for (std::size_t tap = 0; tap < t.taps(cell); ++tap) {
    const std::size_t source = tap < n ? cell : t.link_to[t.first_link[cell] + tap / n - 1];
    inputs.push_back({mesh.node_of_cell(source), static_cast<std::uint32_t>(tap % n),
                      network.weight[row + tap], outputs[source * n + tap % n]});
  }
  return inputs;
}

FirstDifference locate(std::uint32_t sweep, const Codes& before, const Codes& a, const Codes& b,
                       const BuiltMesh& mesh, const spec::ArraySpec& array, const LoadedNetwork& network) {
  const spec::Phases phases = spec::phases_of(mesh.topology(), array.schedule);
  const spec::CycleModel cycles = spec::cycle_model(array, mesh.topology(), phases);
  FirstDifference d;
  d.sweep = sweep;
  d.cycle = cycles.run(sweep - 1);
  for (std::size_t k = 0; k < phases.size(); ++k) {
    d.cycle += cycles.phase[k];
    for (std::uint32_t neuron : phases[k]) {
      if (a[neuron] == b[neuron]) continue;
      d.node = mesh.node_of_cell(neuron / mesh.components());
      d.component = neuron % static_cast<std::uint32_t>(mesh.components());
      d.raw[0] = a[neuron], d.raw[1] = b[neuron];
      d.before_raw = before[neuron], d.bias_raw = network.bias[neuron];
      d.inputs = inputs_of(neuron, mesh, network, in_sweep(phases, k, before, a));
      d.cycle -= 1; // a phase of cycles c ... e publishes in cycle e
      return d;
    }
  }
  return d;
}

} // namespace

LoadedNetwork loaded_network(const hm_bus& bus, const spec::Topology& topology, Codes start) {
  LoadedNetwork network;
  network.weight = read_window(bus, HM_WINDOW_WEIGHT, topology.weight_words());
  network.bias = read_window(bus, HM_WINDOW_BIAS, topology.neurons());
  network.start = std::move(start);
  must(bus.read(bus.context, HM_REG_THRESHOLD, &network.threshold));
  must(bus.read(bus.context, HM_REG_MAX_SWEEPS, &network.max_sweeps));
  return network;
}

std::optional<FirstDifference> first_difference(const hm_bus& a, const hm_bus& b, const BuiltMesh& mesh,
                                                const spec::ArraySpec& array, const LoadedNetwork& network) {
  Codes before = network.start;
  for (std::uint32_t sweep = 1; sweep <= network.max_sweeps; ++sweep) {
    Codes at_a = after_sweeps(a, network, sweep), at_b = after_sweeps(b, network, sweep);
    if (at_a != at_b) return locate(sweep, before, at_a, at_b, mesh, array, network);
    if (at_a == before) break; // at rest: nothing will change any more
    before = std::move(at_a);
  }
  return std::nullopt;
}

} // namespace hopmesh::study
