// How sure an answer of an array is: what one solve tells against what is measured, and what the formats
// bound beforehand, over scenes, seeds and stages. Measured: against the exact answer of the loaded network,
// and of the host's.
#include "rtl_model/spec/presets.h"
#include "sim/levels/networks/told_error.h"
#include "sim/networks/array_solver.h"
#include "sim/networks/certainty.h"
#include "sim/networks/step_problem.h"
#include "tests/networks/quadratics.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

using networks::Certainty;
using Overrides = std::vector<std::string>;

/// An array's rest, against the network in its memories and against the host's.
struct Looked {
  Certainty loaded, asked;
  bool converged = false;
};

Looked look(const std::string& scene, const std::string& preset, int step, const Overrides& overrides) {
  const levels::Prepared p = levels::prepare(scene, preset, overrides);
  levels::ReferenceMover motion(p.inputs.scene, *p.mesh, p.inputs.array);
  for (int k = 0; k < step; ++k) motion.advance();
  const levels::StepState before = motion.state();
  motion.advance();
  const solvers::Problem whole = networks::step_problem(motion, before, p, {});
  networks::StepArray array(whole, p, p.inputs.array);
  Looked looked;
  looked.converged = array.rest().converged;
  const reference::Order order = levels::order_for(*p.mesh, p.inputs.array.schedule);
  const auto judged = [&](const solvers::Problem& problem, bool loads) {
    levels::RunRules rules = levels::rules_of(levels::motion_for(p.inputs.scene, p.inputs.array));
    rules.loads = loads;
    const levels::ErrorBounds bounds({problem.W, problem.I}, order, true);
    return networks::certainty_of(problem, array.whole_outputs(), bounds, p.inputs.array, rules);
  };
  looked.loaded = judged(array.loaded().value(), false);
  looked.asked = judged(whole, true);
  return looked;
}

void expect_told(const Certainty& c) {
  ASSERT_TRUE(c.told);
  if (c.held > 0) return;
  EXPECT_GT(*c.told, 0.9 * c.measured);
  EXPECT_LT(*c.told, 1.1 * c.measured);
}

struct Case {
  const char* scene;
  Overrides overrides;
};
const std::vector<Case> cases{
    {"banner", {}},
    {"stiff", {}},
    {"large-step", {"relax.expansions=1"}},
    {"tablecloth", {}},
    {"tablecloth", {"mesh.start.seed=2"}},
    {"tablecloth", {"mesh.start.seed=3"}},
};

/// Bound over measured, of all cases that came to rest: never below 1.
std::vector<double> ratios_of(const std::string& preset, const Overrides& more) {
  std::vector<double> ratios;
  for (const Case& c : cases) {
    Overrides overrides = c.overrides;
    overrides.insert(overrides.end(), more.begin(), more.end());
    const Looked looked = look(c.scene, preset, 10, overrides);
    for (const Certainty* certainty : {&looked.loaded, &looked.asked}) {
      SCOPED_TRACE(c.scene + (" " + preset));
      expect_told(*certainty);
      if (!looked.converged || !certainty->bound || certainty->held > 0) continue;
      EXPECT_GE(certainty->bound->least(), certainty->measured);
      EXPECT_GE(certainty->bound->norm, certainty->measured);
    }
    if (looked.converged && looked.loaded.bound)
      ratios.push_back(looked.loaded.bound->least() / looked.loaded.measured);
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

class BoundOfStage : public ::testing::TestWithParam<const char*> {};

void print(const char* preset, const std::vector<double>& ratios) {
  std::cout << preset << ": bound over measured";
  for (const double ratio : ratios) std::cout << ' ' << ratio;
  std::cout << '\n';
}

// Link = state: the case in which a bound is of use. True as well with steps that swing about the rest,
// where neighbours' errors do not add up as the bound takes them to.
TEST_P(BoundOfStage, holds) {
  const std::vector<double> ratios = ratios_of(GetParam(), {});
  print(GetParam(), ratios);
  ASSERT_EQ(ratios.size(), cases.size());
  if (std::string(GetParam()) != "descent-projected") {
    EXPECT_LE(ratios[ratios.size() / 2], 10);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, BoundOfStage,
                         ::testing::Values("descent", "descent-projected", "descent-momentum"),
                         [](const auto& made) {
                           std::string name = made.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// A coarser link: true, and of little use. The figure says which case it is.
TEST(Bound, saysItsCase) {
  const Looked coarse = look("banner", "guarded", 3, {}), equal = look("banner", "descent", 3, {});
  ASSERT_TRUE(coarse.asked.bound && equal.asked.bound);
  EXPECT_FALSE(coarse.asked.bound->link_is_state);
  EXPECT_TRUE(equal.asked.bound->link_is_state);
  EXPECT_GE(coarse.asked.bound->least(), coarse.asked.measured);
  EXPECT_TRUE(equal.asked.bound->proved);
  EXPECT_NE(networks::bound_text(coarse.asked.bound).find("the link is coarser"), std::string::npos);
  EXPECT_NE(networks::bound_text(equal.asked.bound).find("link = state"), std::string::npos);
}

TEST(Bound, ofMomentumByChangeIsAssumedAndBySumProved) {
  const Overrides momentum{"array.output=momentum", "array.schedule=synchronous"};
  Overrides by_sum = momentum;
  by_sum.push_back("relax.stop=sum");
  const Looked change = look("banner", "guarded", 3, momentum), sum = look("banner", "guarded", 3, by_sum);
  ASSERT_TRUE(change.asked.bound && sum.asked.bound);
  EXPECT_FALSE(change.asked.bound->proved);
  EXPECT_TRUE(sum.asked.bound->proved);
  for (const Looked* looked : {&change, &sum}) {
    EXPECT_GE(looked->asked.bound->least(), looked->asked.measured);
    EXPECT_GE(looked->loaded.bound->least(), looked->loaded.measured);
  }
}

TEST(Bound, isClaimedWhereItHoldsOnly) {
  const levels::RunRules rules;
  Random random(5);
  const solvers::Problem p = random_convex(random, 12, 0.2);
  const levels::ErrorBounds bounds({p.W, p.I}, p.colours, true);
  ASSERT_TRUE(bounds.definite());
  EXPECT_TRUE(bounds.of(spec::guarded_array(), rules));
  EXPECT_FALSE(bounds.of(spec::prescaled_array(), rules)) << "its rows are no network's";
  spec::ArraySpec signs;
  signs.output = spec::Output::binary;
  EXPECT_FALSE(bounds.of(signs, rules));
  spec::ArraySpec rounds;
  rounds.exact_accumulator = false;
  EXPECT_FALSE(bounds.of(rounds, rules));
  const solvers::Problem saddle = random_problem(random, 12);
  EXPECT_FALSE(levels::ErrorBounds({saddle.W, saddle.I}, saddle.colours, true).definite());
}

/// V* of a small dense problem without a box.
TEST(ToldError, isTheErrorItself) {
  Random random(7);
  int told_of = 0;
  for (int k = 0; k < 60; ++k) {
    const solvers::Problem p = random_convex(random, 2 + k % 9, 0.1);
    const Eigen::MatrixXd W = p.W;
    const solvers::Vector answer = (-W).ldlt().solve(p.I);
    const auto told = levels::told_error({p.W, p.I}, p.start);
    ASSERT_TRUE(told);
    EXPECT_EQ(told->is_estimate(), answer.cwiseAbs().maxCoeff() > 1) << k;
    if (told->is_estimate()) continue;
    told_of += 1;
    EXPECT_LT((told->error - (p.start - answer)).norm(), 1e-9 * (1 + answer.norm()));
  }
  EXPECT_GT(told_of, 20);
}

// Outputs at bounds that stay there leave the others to be told, and then that is exact, too.
TEST(ToldError, isOfTheFreeWhereBoundsHold) {
  Random random(8);
  int held = 0;
  for (int k = 0; k < 40; ++k) {
    const solvers::Problem p = random_convex(random, 2 + k % 6, 4);
    const solvers::Vector answer = answer_by_faces(p);
    solvers::Vector V = answer;
    for (Eigen::Index i = 0; i < V.size(); ++i)
      if (std::abs(answer[i]) < 0.99) V[i] += 1e-3;
    const auto told = levels::told_error({p.W, p.I}, V);
    ASSERT_TRUE(told);
    if (told->held == 0 || (V - answer).cwiseAbs().maxCoeff() == 0) continue;
    held += 1;
    if ((solvers::into_box(V - told->error) - (V - told->error)).norm() > 1e-12)
      continue; // another bound is met
    EXPECT_LT((told->error - (V - answer)).norm(), 1e-8) << k;
  }
  EXPECT_GT(held, 10);
}

TEST(ToldError, isNotToldOfASaddle) {
  reference::Matrix W(2, 2);
  W.insert(0, 0) = 1, W.insert(1, 1) = -1;
  W.makeCompressed();
  EXPECT_FALSE(levels::told_error({W, Eigen::Vector2d(0.1, 0.1)}, Eigen::Vector2d(0, 0)));
}

} // namespace
} // namespace hopmesh::tests
