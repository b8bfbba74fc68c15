#include "sim/machine/timeline.h"

#include "rtl_model/spec/cycles.h"
#include "rtl_model/spec/memory_map.h"
#include "sim/machine/silicon.h"

namespace hopmesh::machine {

namespace {

spec::CycleModel cycles_of_array(const spec::ArraySpec& array, const spec::Topology& topology) {
  return spec::cycle_model(array, topology, spec::phases_of(topology, array.schedule));
}

/// Of all words of a window, burst by burst.
std::uint64_t burst_cycles(const spec::ArraySpec& array, std::uint64_t words, std::uint64_t longest) {
  std::uint64_t cycles = words / longest * spec::bus_cycles(array, longest);
  if (words % longest > 0) cycles += spec::bus_cycles(array, words % longest);
  return cycles;
}

} // namespace

Timeline timeline_of(const spec::ArraySpec& array, const spec::Topology& topology, const Work& work) {
  Timeline t;
  t.bus = work.bus_cycles;
  t.sweeps = std::min(work.array_cycles, work.sweeps * cycles_of_array(array, topology).sweep);
  t.prepare = work.array_cycles - t.sweeps;
  t.multipliers = parts_of(array, topology).multipliers;
  t.products = work.sweeps * topology.weight_words();
  t.host_seconds = work.host_seconds;
  return t;
}

RunTransfers run_transfers(const spec::ArraySpec& array, const spec::Topology& topology,
                           std::size_t longest_burst) {
  const spec::MemoryMap map = spec::memory_map(array, topology);
  const auto burst = [&](spec::Window w) { return burst_cycles(array, map[w].words(), longest_burst); };
  const std::uint64_t five_registers = 5 * spec::bus_cycles(array, 1);
  return {five_registers + burst(spec::Window::WEIGHT) + burst(spec::Window::BIAS) +
              burst(spec::Window::OUTPUT),
          five_registers + burst(spec::Window::OUTPUT)};
}

Work work_of(const spec::ArraySpec& array, const spec::Topology& topology, std::uint64_t runs,
             std::uint64_t sweeps, std::size_t longest_burst) {
  const spec::CycleModel m = cycles_of_array(array, topology);
  const RunTransfers bus = run_transfers(array, topology, longest_burst);
  return {runs * m.run(0) + sweeps * m.sweep, runs * (bus.load + bus.read), sweeps};
}

} // namespace hopmesh::machine
