#include "sim/levels/networks/corrections.h"

#include <cmath>

namespace hopmesh::levels {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double wanted_change = 0.5;    // of the array's range
constexpr double clipped_change = 0.875; // from there on a change is asked for again in larger units
constexpr double last_places = 0x1p-40;
constexpr int most_retries = 60, most_halvings = 8;

double largest_of(const VectorXd& values) {
  return values.size() == 0 ? 0 : values.cwiseAbs().maxCoeff();
}

bool pushed_out(double V, double s) {
  return (V >= 1 && s > 0) || (V <= -1 && s < 0);
}

} // namespace

Corrections::Corrections(const reference::Network& network, double room, Asked ask)
    : network_(network), room_(room), ask_(std::move(ask)) {}

void Corrections::learn_from(const VectorXd& V0, const VectorXd& V) {
  const double whole = largest_of(reference::movable_input(network_, V0));
  if (whole > 0) softness_ = largest_of(V - V0) / whole;
}

double Corrections::residual(const VectorXd& V) const {
  const double whole = largest_of(network_.I);
  return whole > 0 ? largest_of(reference::movable_input(network_, V)) / whole : 0;
}

// A neuron that a bound holds stands at +1, pushed by more than its row can pull, and its neighbours' biases
// lose what it does to them there: to them it has not moved.
void Corrections::hold(const VectorXd& V, const VectorXd& s, VectorXd& bias, VectorXd& output) const {
  for (Index i = 0; i < V.size(); ++i)
    if (pushed_out(V[i], s[i]))
      for (reference::Matrix::InnerIterator w(network_.W, i); w; ++w) bias[w.col()] -= w.value();
  for (Index i = 0; i < V.size(); ++i)
    if (pushed_out(V[i], s[i])) {
      double sum = 0;
      for (reference::Matrix::InnerIterator w(network_.W, i); w; ++w) sum += std::abs(w.value());
      bias[i] = std::min(2 * sum, room_);
      output[i] = 1;
    }
}

VectorXd Corrections::change_for(const VectorXd& V, const VectorXd& s) {
  const double left = largest_of(reference::movable_input(network_, V));
  const double expected = left * (softness_ > 0 ? softness_ : 1 / largest_of(network_.W.diagonal()));
  double unit = std::exp2(std::ceil(std::log2(expected / wanted_change)));
  while (unit * room_ < left) unit *= 2;
  for (int k = 0;; ++k, unit *= 4) {
    VectorXd bias = s / unit, output = VectorXd::Zero(V.size());
    hold(V, s, bias, output);
    VectorXd change = ask_(bias, output);
    for (Index i = 0; i < V.size(); ++i)
      if (pushed_out(V[i], s[i])) change[i] = 0;
    if (largest_of(change) > clipped_change && k < most_retries) continue;
    softness_ = unit * largest_of(change) / left;
    return unit * change;
  }
}

bool Corrections::correct(VectorXd& V) {
  const VectorXd s = network_.W * V + network_.I;
  if (!(largest_of(reference::movable_input(network_, V)) > 0)) return false;
  const VectorXd change = change_for(V, s);
  for (int k = 0; k <= most_halvings; ++k) {
    const VectorXd wanted = V + std::ldexp(1.0, -k) * change;
    const VectorXd boxed = wanted.cwiseMin(1).cwiseMax(-1);
    if (reference::fall(network_, V, boxed) > 0) {
      V = boxed;
      ++made_.corrections;
      return true;
    }
    if (boxed == wanted) break;
  }
  if (largest_of(change) > last_places) ++made_.refused;
  return false;
}

} // namespace hopmesh::levels
