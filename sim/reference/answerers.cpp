#include "sim/reference/answerers.h"

#include "sim/reference/rest.h"

#include <algorithm>

namespace hopmesh::reference {

Answerer by_equal_sweeps(SweepsOfSteps sweeps, Neuron neuron) {
  std::uint64_t last = 0;
  std::size_t asked = 0; // in that step
  return [sweeps = std::move(sweeps), neuron, last, asked](const Network& network, const Order& order,
                                                           const Vector& V0, std::uint64_t step) mutable {
    if (step != last) asked = 0;
    last = step;
    std::uint32_t count = 0;
    if (step < sweeps.size() && !sweeps[step].empty())
      count = sweeps[step][std::min(asked++, sweeps[step].size() - 1)];
    Relaxation end = relax(network, order, V0, -1, count, neuron); // no threshold ends it
    end.converged = true;
    return end;
  };
}

Answerer by_rest(const StepParameters& motion, Eigen::Index components) {
  const double threshold = motion.threshold;
  const std::uint32_t sweeps = motion.max_sweeps;
  if (motion.neuron == Neuron::binary)
    return [sweeps](const Network& network, const Order& order, const Vector& V0, std::uint64_t) {
      return relax(network, order, V0, 0, sweeps, Neuron::binary);
    };
  return [=](const Network& network, const Order& order, const Vector& V0, std::uint64_t) {
    Relaxation end = relax(network, order, V0, threshold, sweeps);
    const Rest rest = rest_from(BlockNetwork(network, components), end.V);
    end.V = rest.V;
    end.converged = rest.found;
    return end;
  };
}

} // namespace hopmesh::reference
