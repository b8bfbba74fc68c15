// Neurons at work: inputs are summed, outputs follow them by their rule (docs/method/theory.md, section 3),
// phase by phase.
#include "sim/reference/sweeper.h"

#include "sim/reference/neuron_sums.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hopmesh::reference {
namespace {

double sign(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

// Output stage (paper eqs. 9 to 12). A neuron that nothing reaches, N = 0, stays. No clamp: s and N are
// summed in the same order, so that |s| <= N survives rounding, and V + (1 - V) rounded twice is at most 1.
double toward_bound(double s, double N, double V) {
  if (N == 0) return V;
  const double u = s / N;
  const double R = u >= 0 ? 1 - V : 1 + V;
  return V + R * u;
}

/// s / divisor, held within +-most; to the end of that where nothing divides s.
double limited(double s, double divisor, double most) {
  return divisor == 0 ? most * sign(s) : std::clamp(s / divisor, -most, most);
}

double in_box(double V) {
  return std::clamp(V, -1.0, 1.0);
}

Vector divisors(const Network& network, Neuron neuron) {
  switch (neuron) {
  case Neuron::projected:
    return Vector(network.W.diagonal()).cwiseAbs();
  case Neuron::momentum:
    return row_sums(network);
  default:
    return normalisers(network);
  }
}

} // namespace

Sweeper::Sweeper(const Network& network, const Order& order, const NeuronRule& rule, Vector V)
    : network_(network), order_(order), rule_(rule), divisor_(divisors(network, rule.neuron)),
      V_(std::move(V)), s_(V_.size()), change_(Vector::Zero(V_.size())) {
  if (rule.neuron != Neuron::momentum) return;
  if (order.size() > 1) throw std::logic_error("momentum fires all neurons at once");
  Y_ = V_;
}

Swept Sweeper::sweep() {
  swept_ = {};
  agreement_ = 0;
  for (const auto& phase : order_) fire_together(phase);
  if (rule_.neuron == Neuron::momentum) look_ahead();
  return swept_;
}

// All read the outputs from before the phase, so none is written until all have read.
void Sweeper::fire_together(const std::vector<std::uint32_t>& phase) {
  const Vector& seen = rule_.neuron == Neuron::momentum ? Y_ : V_;
  for (const std::uint32_t neuron : phase) s_[neuron] = input_sum(network_, seen, neuron);
  for (const std::uint32_t neuron : phase) {
    const double s = s_[neuron], next = fired(neuron, s);
    if (may_move(s, seen[neuron])) swept_.largest_input = std::max(swept_.largest_input, std::abs(s));
    change_[neuron] = next - V_[neuron];
    V_[neuron] = next;
    agreement_ += sign(s) * change_[neuron];
    swept_.largest_change = std::max(swept_.largest_change, std::abs(change_[neuron]));
  }
}

// Not from a bound that s pushes against, or leaves alone. `from`: where the neuron was when s was summed.
bool Sweeper::may_move(double s, double from) const {
  const double bound = 1 - rule_.nearness;
  return !(from >= bound && s >= 0) && !(from <= -bound && s <= 0);
}

double Sweeper::fired(Eigen::Index neuron, double s) const {
  const double V = V_[neuron], divisor = divisor_[neuron];
  switch (rule_.neuron) {
  case Neuron::binary:
    return s > 0 || s < 0 ? sign(s) : V;
  case Neuron::projected:
    return in_box(V + limited(rule_.relaxation * s, divisor, 2));
  case Neuron::momentum:
    return in_box(Y_[neuron] + limited(s, divisor, 1));
  default:
    return toward_bound(s, divisor, V);
  }
}

// Behind every sweep. Where the step went against the inputs as a whole, what was gathered is dropped: a
// restart (O'Donoghue and Candes 2015, by signs).
void Sweeper::look_ahead() {
  const bool restart = agreement_ < 0;
  if (restart) entry_ = 0;
  const double m = restart || rule_.momentum.empty() ? 0 : rule_.momentum[entry_];
  for (Eigen::Index k = 0; k < V_.size(); ++k) Y_[k] = in_box(V_[k] + m * change_[k]);
  if (entry_ + 1 < rule_.momentum.size()) entry_ += 1;
}

} // namespace hopmesh::reference
