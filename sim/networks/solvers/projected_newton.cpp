// An active-set Newton method (in the manner of More and Toraldo 1991): exact after a few factorisations.
#include "sim/networks/solvers/all_solvers.h"
#include "sim/networks/solvers/factor.h"
#include "sim/networks/solvers/spectrum.h"

#include <cmath>

namespace hopmesh::solvers {
namespace {

class ProjectedNewton : public Solver {
 public:
  explicit ProjectedNewton(const Problem& problem) : Solver(problem), step_(1 / largest_curvature(problem)) {}

  // The gradient step releases whatever wants away from its bound, and finds new bounds; it never climbs.
  void sweep() override {
    V_ = into_box(V_ + step_ * inputs(problem_, V_));
    const Vector s = inputs(problem_, V_);
    search(s, newton_direction(s));
  }

 private:
  Vector newton_direction(const Vector& s) {
    std::vector<Eigen::Index> between;
    for (Eigen::Index i = 0; i < V_.size(); ++i)
      if (std::abs(V_[i]) < 1) between.push_back(i);
    Vector d = Vector::Zero(V_.size());
    if (between.empty()) return d;
    Vector b(between.size());
    for (std::size_t k = 0; k < between.size(); ++k) b[static_cast<Eigen::Index>(k)] = s[between[k]];
    const Vector x = Factor(problem_.W, between, 0).solve(b);
    ++factorisations_;
    for (std::size_t k = 0; k < between.size(); ++k) d[between[k]] = x[static_cast<Eigen::Index>(k)];
    return d;
  }

  // Along the path that the box bends, half as far until the energy falls.
  void search(const Vector& s, const Vector& d) {
    constexpr int most_halvings = 60;
    double share = 1;
    for (int k = 0; k < most_halvings; ++k, share /= 2) {
      const Vector there = into_box(V_ + share * d);
      if (!(rise(problem_, s, there - V_) < 0)) continue;
      V_ = there;
      return;
    }
  }

  const double step_;
};

} // namespace

std::unique_ptr<Solver> make_projected_newton(const Problem& problem) {
  return std::make_unique<ProjectedNewton>(problem);
}

} // namespace hopmesh::solvers
