// A sparse LDL' solve: the whole answer wherever the box does not matter.
#include "sim/networks/solvers/all_solvers.h"
#include "sim/networks/solvers/factor.h"

namespace hopmesh::solvers {
namespace {

class Cholesky : public Solver {
 public:
  explicit Cholesky(const Problem& problem) : Solver(problem) {}

  void sweep() override {
    const Factor factor(problem_.W, all_outputs(problem_), 0);
    ++factorisations_;
    const Vector answer = factor.solve(problem_.I);
    const auto outside = (answer.array().abs() > 1).count();
    if (outside > 0)
      throw Unfit("a bound is active: without the box " + std::to_string(outside) + " of " +
                  std::to_string(answer.size()) + " outputs leave it");
    V_ = answer;
  }
};

} // namespace

std::unique_ptr<Solver> make_cholesky(const Problem& problem) {
  return std::make_unique<Cholesky>(problem);
}

} // namespace hopmesh::solvers
