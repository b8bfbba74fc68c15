// Alternating directions (ADMM): a prefactored linear solve, a clamp, and a price for what they disagree by.
#include "sim/networks/solvers/all_solvers.h"
#include "sim/networks/solvers/factor.h"
#include "sim/networks/solvers/spectrum.h"

namespace hopmesh::solvers {
namespace {

class Admm : public Solver {
 public:
  Admm(const Problem& problem, double rho_share)
      : Solver(problem), rho_(rho_share * largest_curvature(problem)),
        factor_(problem.W, all_outputs(problem), rho_), price_(Vector::Zero(V_.size())) {
    factorisations_ = 1;
  }

  void sweep() override {
    const Vector x = factor_.solve(problem_.I + rho_ * (V_ - price_));
    V_ = into_box(x + price_);
    price_ += x - V_;
  }

 private:
  const double rho_;
  const Factor factor_;
  Vector price_;
};

} // namespace

std::unique_ptr<Solver> make_admm(const Problem& problem, double rho_share) {
  return std::make_unique<Admm>(problem, rho_share);
}

} // namespace hopmesh::solvers
