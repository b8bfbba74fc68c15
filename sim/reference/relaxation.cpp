// The modified Hopfield network until it rests, and how far from rest it is (docs/method/theory.md, section
// 3).
#include "sim/reference/neuron_sums.h"
#include "sim/reference/sweeper.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::reference {

std::vector<double> fista(std::size_t entries) {
  std::vector<double> table;
  for (double t = 1; table.size() < entries;) {
    const double next = (1 + std::sqrt(1 + 4 * t * t)) / 2;
    table.push_back((t - 1) / next);
    t = next;
  }
  return table;
}

Relaxation relax(Sweeper& sweeper, const Stop& stop) {
  Relaxation result;
  double first = 0;
  while (result.sweeps < stop.max_sweeps && !result.converged) {
    const Swept swept = sweeper.sweep();
    if (result.sweeps == 0) first = swept.largest_input;
    result.converged =
        stop.share ? swept.largest_input <= *stop.share * first : swept.largest_change <= stop.threshold;
    ++result.sweeps;
  }
  result.V = sweeper.V();
  return result;
}

Relaxation relax(const Network& network, const Order& order, Vector V, const Stop& stop,
                 const NeuronRule& rule) {
  Sweeper sweeper(network, order, rule, std::move(V));
  return relax(sweeper, stop);
}

Relaxation relax(const Network& network, const Order& order, Vector V, double threshold,
                 std::uint32_t max_sweeps, const NeuronRule& rule) {
  return relax(network, order, std::move(V), Stop{threshold, max_sweeps}, rule);
}

// How far a step of u = s / N along the negative gradient gets before the box stops it. That is 0 exactly
// where the KKT conditions hold: s = 0, or V at a bound with s pushing outward (docs/method/theory.md,
// section 3).
double kkt_violation(const Network& network, const Vector& V) {
  const Vector N = normalisers(network);
  double largest = 0;
  for (Eigen::Index neuron = 0; neuron < V.size(); ++neuron) {
    if (N[neuron] == 0) continue;
    const double u = input_sum(network, V, neuron) / N[neuron];
    largest = std::max(largest, std::abs(std::clamp(V[neuron] + u, -1.0, 1.0) - V[neuron]));
  }
  return largest;
}

Vector movable_input(const Network& network, const Vector& V) {
  Vector s = network.W * V + network.I;
  for (Eigen::Index k = 0; k < s.size(); ++k)
    if ((V[k] >= 1 && s[k] > 0) || (V[k] <= -1 && s[k] < 0)) s[k] = 0;
  return s;
}

double fall(const Network& network, const Vector& from, const Vector& to) {
  const Vector way = to - from;
  return way.dot(network.W * from + network.I) + way.dot(network.W * way) / 2;
}

} // namespace hopmesh::reference
