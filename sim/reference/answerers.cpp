#include "sim/reference/answerers.h"

#include "sim/reference/rest.h"

#include <algorithm>

namespace hopmesh::reference {

Answerer by_equal_sweeps(SweepsOfSteps sweeps, const NeuronRule& rule) {
  std::uint64_t last = 0;
  std::size_t asked = 0; // in that step
  return [sweeps = std::move(sweeps), rule, last, asked](const Network& network, const Order& order,
                                                         const Vector& V0, std::uint64_t step) mutable {
    if (step != last) asked = 0;
    last = step;
    std::uint32_t count = 0;
    if (step < sweeps.size() && !sweeps[step].empty())
      count = sweeps[step][std::min(asked++, sweeps[step].size() - 1)];
    Relaxation end = relax(network, order, V0, -1, count, rule); // no threshold ends it
    end.converged = true;
    return end;
  };
}

Answerer by_rest(const StepParameters& motion, Eigen::Index components) {
  const Stop stop = motion.stop();
  const NeuronRule rule = motion.rule;
  if (rule.neuron == Neuron::binary)
    return [=](const Network& network, const Order& order, const Vector& V0, std::uint64_t) {
      return relax(network, order, V0, 0, stop.max_sweeps, rule);
    };
  return [=](const Network& network, const Order& order, const Vector& V0, std::uint64_t) {
    Relaxation end = relax(network, order, V0, stop, rule);
    const Rest rest = rest_from(BlockNetwork(network, components), end.V);
    end.V = rest.V;
    end.converged = rest.found;
    return end;
  };
}

} // namespace hopmesh::reference
