// Conjugate gradients on the outputs between the bounds, as MPRGP has them (Dostal, Schoeberl 2005), with
// sum_j |W_ij| for a preconditioner, which also bounds the curvature: a step of s_i / sum_j |W_ij| of all
// outputs at once, back into the box, never climbs. Where the curvature is negative the way leads to a bound.
#include "sim/reference/rest.h"

#include <algorithm>
#include <cmath>

namespace hopmesh::reference {
namespace {

constexpr double rounding = 0x1p-52;
constexpr double still = rounding / 4; // a violation by the residual carried along: nothing left to gain
constexpr double flat = 1e-15;         // of the curvature that the weights allow: as good as none
constexpr int most_refinements = 8;    // from a residual computed anew

class Resting {
 public:
  Resting(const BlockNetwork& network, const Vector& V, std::uint32_t most_products)
      : network_(network), most_(most_products), nothing_(network.nodes(), Quad{}), V_(network.spread(V)),
        s_(nothing_), free_(nothing_), direction_(nothing_), change_(nothing_), step_(nothing_),
        next_V_(nothing_), next_s_(nothing_) {
    for (std::size_t node = 0; node < network.nodes(); ++node)
      for (int p = 0; p < 4; ++p) set_out(node, p);
  }

  Rest come_to_rest() {
    Rest rest;
    rest.violation = HUGE_VAL;
    measure();
    for (int refinement = 0; refinement < most_refinements; ++refinement) {
      const double before = rest.violation;
      if (standing_.violation < before) rest.V = network_.gathered(V_), rest.violation = standing_.violation;
      if (standing_.violation <= 2 * rounding || standing_.violation > before / 2) break;
      descend();
      measure();
    }
    rest.products = products_;
    rest.found = rest.violation <= 16 * rounding;
    return rest;
  }

  Vector go_down() {
    measure();
    descend();
    return network_.gathered(V_);
  }

 private:
  // What no weight reaches goes where its bias says.
  void set_out(std::size_t node, int p) {
    const double reach = network_.magnitude()[node].lane[p], bias = network_.bias()[node].lane[p];
    if (reach > 0)
      step_[node].lane[p] = 1 / reach;
    else if (bias != 0)
      V_[node].lane[p] = bias > 0 ? 1 : -1;
  }

  DescentFields fields() const {
    return {network_.magnitude().data(), step_.data(),  V_.data(), s_.data(),
            direction_.data(),           change_.data()};
  }

  void measure() {
    network_.inputs(network_.bias(), V_, s_);
    ++products_;
    fresh_ = true;
    standing_ = network_.kernel().walk(V_.size(), fields(), 0, V_.data(), s_.data(), free_.data());
  }

  /// Until what is left is rounding by the residual carried along.
  void descend() {
    while (products_ < most_ && standing_.violation > still)
      if (standing_.inward_slope > standing_.free_slope)
        step_downhill();
      else if (!conjugate_step())
        return;
  }

  template <typename Moved> void move_each(Moved moved) {
    for (std::size_t node = 0; node < V_.size(); ++node)
      for (int p = 0; p < 4; ++p) {
        double& V = V_[node].lane[p];
        V = std::clamp(moved(node, p, V), -1.0, 1.0);
      }
    measure();
  }

  void step_downhill() {
    move_each([&](std::size_t node, int p, double V) { return V + step_[node].lane[p] * s_[node].lane[p]; });
  }

  /// False where only rounding could still say where to go.
  bool conjugate_step() {
    const BlockKernel& kernel = network_.kernel();
    kernel.turn(V_.size(), step_.data(), free_.data(), fresh_ ? 0 : standing_.free_slope / slope_,
                direction_.data());
    slope_ = standing_.free_slope;
    fresh_ = false;
    network_.inputs(nothing_, direction_, change_);
    ++products_;
    double curvature, most;
    kernel.bend(V_.size(), fields(), curvature, most);
    if (!(curvature > flat * most)) {
      if (standing_.violation <= 16 * rounding) return false;
      go_to_bound(HUGE_VAL);
      return true;
    }
    const double far = slope_ / curvature;
    const Standing there =
        kernel.walk(V_.size(), fields(), far, next_V_.data(), next_s_.data(), free_.data());
    if (!there.inside) {
      if (!bend_along_box(far)) go_to_bound(far);
      return true;
    }
    V_.swap(next_V_);
    s_.swap(next_s_);
    standing_ = there;
    return true;
  }

  /// The whole way, along the bounds where they are met: many outputs may come to theirs at once. False, and
  /// nothing done, where that would climb.
  bool bend_along_box(double far) {
    next_V_.swap(V_), next_s_.swap(s_);
    V_ = next_V_;
    move_each([&](std::size_t node, int p, double V) { return V + far * direction_[node].lane[p]; });
    double fall = 0;
    for (std::size_t node = 0; node < V_.size(); ++node)
      for (int p = 0; p < 4; ++p)
        fall += (V_[node].lane[p] - next_V_[node].lane[p]) * (s_[node].lane[p] + next_s_[node].lane[p]);
    if (fall > 0) return true;
    next_V_.swap(V_), next_s_.swap(s_);
    return false;
  }

  // As far as the first bound in the way, and on by a step in which others may come to theirs.
  void go_to_bound(double wanted) {
    const auto room = [&](std::size_t node, int p) {
      const double d = direction_[node].lane[p];
      return d == 0 ? HUGE_VAL : (std::copysign(1, d) - V_[node].lane[p]) / d;
    };
    double most = wanted;
    for (std::size_t node = 0; node < V_.size(); ++node)
      for (int p = 0; p < 4; ++p) most = std::min(most, room(node, p));
    move_each([&](std::size_t node, int p, double V) {
      const double d = direction_[node].lane[p];
      return d == 0 ? V : room(node, p) <= most ? std::copysign(1, d) : V + most * d;
    });
    step_downhill();
  }

  const BlockNetwork& network_;
  const std::uint32_t most_;
  std::uint32_t products_ = 0;
  bool fresh_ = true; ///< no direction yet to be conjugate to
  double slope_ = 0;
  Standing standing_;
  const Quads nothing_;
  Quads V_, s_, free_, direction_, change_, step_, next_V_, next_s_;
};

} // namespace

Rest rest_from(const BlockNetwork& network, const Vector& V, std::uint32_t most_products) {
  if (V.size() == 0) return {V, 0, 0, true};
  return Resting(network, V, most_products).come_to_rest();
}

Vector way_down(const BlockNetwork& network, const Vector& V, std::uint32_t products) {
  return V.size() == 0 ? V : Resting(network, V, products).go_down();
}

double energy_above(const BlockNetwork& network, const Vector& rest, const Vector& V) {
  const Vector way = V - rest;
  Quads s(network.nodes()), bend(network.nodes());
  network.inputs(network.bias(), network.spread(rest), s);
  network.inputs(Quads(network.nodes(), Quad{}), network.spread(way), bend);
  return -network.gathered(s).dot(way) - 0.5 * network.gathered(bend).dot(way);
}

} // namespace hopmesh::reference
