// What a network would still fall by: a rest of it below given outputs, and how far down that is. Nothing
// here is the neuron's rule: conjugate gradients among the outputs that may move find the rest of a definite
// network to round-off, and of any other a rest that lies below.
#include "sim/reference/reference.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::reference {
namespace {

constexpr int most_rounds = 60, most_iterations = 2000;
constexpr double part = 1e-10, whole = 1e-16; // of the square of s, in a round and in all
constexpr double rounding = 1e-14;            // of what could reach a neuron at most

Vector input(const Network& network, const Vector& V) {
  return network.W * V + network.I;
}

Vector in_box(const Vector& V) {
  return V.cwiseMax(-1.0).cwiseMin(1.0);
}

// What could reach each neuron from the others and itself: E(V + d) <= E(V) - s'd + 1/2 sum N d^2 for any d.
Vector reach(const Network& network) {
  Vector N = network.W.cwiseAbs() * Vector::Ones(network.I.size());
  return N.unaryExpr([](double n) { return n > 0 ? n : 1.0; });
}

/// Descends in rounds: a small step that lets go of the bounds it can, then conjugate gradients among the
/// outputs that are free, as far as the box lets them.
class Descent {
 public:
  Descent(const Network& network, Vector V)
      : network_(network), V_(std::move(V)), N_(reach(network)),
        own_(network.W.diagonal().cwiseAbs().unaryExpr([](double w) { return w > 0 ? w : 1.0; })) {}

  Vector rest() {
    double first = 0;
    for (int round = 0; round < most_rounds; ++round) {
      Vector s = movable_input(network_, V_);
      const double square = size_of(s);
      if (round == 0) first = square;
      if (square <= whole * first || s.cwiseQuotient(N_).cwiseAbs().maxCoeff() <= rounding) break;
      V_ = in_box(V_ + s.cwiseQuotient(N_));
      s = movable_input(network_, V_);
      go(direction(s));
    }
    return V_;
  }

 private:
  double size_of(const Vector& s) const { return s.dot(s.cwiseQuotient(own_)); }

  // Neurons at a bound that s pushes against stay where they are; so do those that nothing reaches.
  Vector without_held(Vector values, const Vector& s) const {
    for (Eigen::Index k = 0; k < values.size(); ++k)
      if (s[k] == 0 && std::abs(V_[k]) >= 1) values[k] = 0;
    return values;
  }

  // Where the form curves down there is no rest along p: it leads out of the box.
  Vector direction(const Vector& s) const {
    Vector d = Vector::Zero(s.size()), r = s, z = r.cwiseQuotient(own_), p = z;
    double square = r.dot(z);
    const double enough = part * square;
    for (int k = 0; k < most_iterations && square > enough; ++k) {
      const Vector q = without_held(-(network_.W * p), s);
      const double curvature = p.dot(q);
      if (curvature <= 0) return k > 0 ? d : Vector(4 / p.cwiseAbs().maxCoeff() * p); // the box is 2 wide
      d += square / curvature * p;
      r -= square / curvature * q;
      z = r.cwiseQuotient(own_);
      const double next = r.dot(z);
      p = z + next / square * p;
      square = next;
    }
    return d;
  }

  // To the first bound, or on with the others while they go on down.
  void go(const Vector& d) {
    double share = 1;
    for (Eigen::Index k = 0; k < d.size(); ++k)
      if (d[k] != 0) share = std::min(share, ((d[k] > 0 ? 1 : -1) - V_[k]) / d[k]);
    const Vector straight = in_box(V_ + share * d), bent = in_box(V_ + d);
    V_ = fall(network_, straight, bent) > 0 ? bent : straight;
  }

  const Network& network_;
  Vector V_;
  const Vector N_, own_;
};

} // namespace

Vector movable_input(const Network& network, const Vector& V) {
  Vector s = input(network, V);
  for (Eigen::Index k = 0; k < s.size(); ++k)
    if ((V[k] >= 1 && s[k] > 0) || (V[k] <= -1 && s[k] < 0)) s[k] = 0;
  return s;
}

double fall(const Network& network, const Vector& from, const Vector& to) {
  const Vector d = to - from;
  return d.dot(input(network, from)) + d.dot(network.W * d) / 2;
}

Vector rest_below(const Network& network, const Vector& V) {
  return Descent(network, in_box(V)).rest();
}

} // namespace hopmesh::reference
