// The modified Hopfield network at work: neurons fire, phase by phase, until they rest
// (docs/method/theory.md, section 3).
#include "sim/reference/reference.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::reference {
namespace {

// Input accumulator: s = sum_j W_ij V_j + I_i, the node itself among the j.
double input_sum(const Network& network, const Vector& V, Eigen::Index neuron) {
  const auto* start = network.W.outerIndexPtr();
  const auto* column = network.W.innerIndexPtr();
  const double* weight = network.W.valuePtr();
  double s = network.I[neuron];
  for (auto k = start[neuron]; k < start[neuron + 1]; ++k) s += weight[k] * V[column[k]];
  return s;
}

// N_i = sum_j |W_ij| + |I_i| (paper eq. 9, diagonal included): what keeps u within [-1, 1]. In the order of
// input_sum.
Vector normalisers(const Network& network) {
  Vector N = network.I.cwiseAbs();
  for (Eigen::Index neuron = 0; neuron < N.size(); ++neuron)
    for (Matrix::InnerIterator w(network.W, neuron); w; ++w) N[neuron] += std::abs(w.value());
  return N;
}

// Output stage (paper eqs. 9 to 12). A neuron that nothing reaches, N = 0, stays. No clamp: s and N are
// summed in the same order, so that |s| <= N survives rounding, and V + (1 - V) rounded twice is at most 1.
double fire(double s, double N, double V) {
  if (N == 0) return V;
  const double u = s / N;
  const double R = u >= 0 ? 1 - V : 1 + V;
  return V + R * u;
}

// The binary neuron (paper eq. 3).
double sign(double s, double V) {
  return s > 0 ? 1 : s < 0 ? -1 : V;
}

/// A network, ready to sweep: everything a sweep needs is allocated here.
class Sweeper {
 public:
  Sweeper(const Network& network, const Order& order, Vector& V, Neuron neuron)
      : network_(network), order_(order), V_(V), N_(normalisers(network)), next_(V.size()), neuron_(neuron) {}

  /// Fires every neuron of the order once; the largest |dV|.
  double sweep() {
    double largest = 0;
    for (const auto& phase : order_) largest = std::max(largest, fire_together(phase));
    return largest;
  }

 private:
  // All read the outputs from before the phase, so none is written until all have read.
  double fire_together(const std::vector<std::uint32_t>& phase) {
    for (const std::uint32_t neuron : phase) {
      const double s = input_sum(network_, V_, neuron);
      next_[neuron] = neuron_ == Neuron::binary ? sign(s, V_[neuron]) : fire(s, N_[neuron], V_[neuron]);
    }
    double largest = 0;
    for (const std::uint32_t neuron : phase) {
      largest = std::max(largest, std::abs(next_[neuron] - V_[neuron]));
      V_[neuron] = next_[neuron];
    }
    return largest;
  }

  const Network& network_;
  const Order& order_;
  Vector& V_;
  Vector N_, next_;
  const Neuron neuron_;
};

} // namespace

Relaxation relax(const Network& network, const Order& order, Vector V, double threshold,
                 std::uint32_t max_sweeps, Neuron neuron) {
  Relaxation result;
  Sweeper sweeper(network, order, V, neuron);
  while (result.sweeps < max_sweeps && !result.converged) {
    result.converged = sweeper.sweep() <= threshold;
    ++result.sweeps;
  }
  result.V = std::move(V);
  return result;
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
