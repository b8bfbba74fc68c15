#include "sim/machine/cost/whole_cost.h"

namespace hopmesh::machine {

double logic_kge(const CostPoint& parts) {
  return whole_figure(parts, Figure::um2) / um2_a_gate / 1000;
}

double memory_kge(const spec::ArraySpec& array, const spec::Topology& topology) {
  return memory_blocks(memories_of(array, topology)).bits * gates_a_bit / 1000;
}

double area_kge(const spec::ArraySpec& array, const spec::Topology& topology) {
  return logic_kge(cost_model().predict(cost_parameters(array, topology))) + memory_kge(array, topology);
}

double energy_joule(const spec::ArraySpec& array, const spec::Topology& topology, const Work& work,
                    std::uint64_t runs) {
  return silicon_energy(activity_of(array, topology, work, runs),
                        cost_model().predict(cost_parameters(array, topology)), Toggles{})
      .total();
}

} // namespace hopmesh::machine
