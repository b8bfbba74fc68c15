// Boxed problems by every output stage, stopped by the inputs of neurons that may still
// move: at the KKT points, whatever the bounds hold.
#include "rtl_model/spec/presets.h"
#include "sim/levels/level.h"
#include "sim/levels/networks/network_level.h"
#include "sim/networks/problems/problem.h"
#include "tests/support/box_solver.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

spec::ArraySpec array_with(spec::Output output) {
  spec::ArraySpec array;
  array.output = output;
  if (output == spec::Output::momentum) array.schedule = spec::Schedule::synchronous;
  return array;
}

class StoppedProblem : public ::testing::TestWithParam<const char*> {};

TEST_P(StoppedProblem, isAtRestInDouble) {
  const problems::Problem p = problems::make(GetParam());
  const levels::GivenNetwork network({p.W, p.bias, p.start}, 0);
  const BoxAnswer answer = least_on_box(p.W, p.bias, p.start);
  ASSERT_TRUE(answer.solved);
  for (const auto output : {spec::Output::modified, spec::Output::projected, spec::Output::momentum}) {
    SCOPED_TRACE(spec::name_of(output));
    const levels::RelaxOptions options{2, 1'000'000, 1e-9}; // any move is below that threshold
    const auto level = levels::reference_level(network, array_with(output), options);
    const spec::Relaxation end = level->relax();
    EXPECT_TRUE(end.converged);
    EXPECT_LT(network.kkt_violation(level->outputs()), 1e-7);
    EXPECT_NEAR(network.energy(level->outputs()), answer.energy, 1e-9 * std::abs(answer.energy));
  }
  EXPECT_TRUE(std::any_of(answer.V.begin(), answer.V.end(), [](double V) { return std::abs(V) == 1; }));
}

TEST_P(StoppedProblem, isAtRestOnTheEngine) {
  const problems::Problem p = problems::make(GetParam());
  const levels::GivenNetwork network({p.W, p.bias, p.start}, 0);
  const BoxAnswer answer = least_on_box(p.W, p.bias, p.start);
  for (const auto output : {spec::Output::projected, spec::Output::momentum}) {
    SCOPED_TRACE(spec::name_of(output));
    spec::ArraySpec array = array_with(output);
    array.formats.link = array.formats.drive = array.formats.state;
    const auto port = levels::default_level().make_port(array, network.topology(), {});
    const auto level = levels::array_level(network, array, {2, 100'000, 0x1p-13}, *port);
    EXPECT_TRUE(level->relax().converged);
    EXPECT_LT(network.kkt_violation(level->outputs()), 1e-3);
    EXPECT_NEAR(network.energy(level->outputs()), answer.energy, 1e-4 * std::abs(answer.energy));
    const Eigen::VectorXd& V = level->outputs();
    EXPECT_TRUE(std::any_of(V.begin(), V.end(), [](double at) { return std::abs(at) == 1; }));
  }
}

INSTANTIATE_TEST_SUITE_P(Of, StoppedProblem,
                         ::testing::Values("box-random-100", "box-membrane-100", "box-membrane-1024"),
                         [](const auto& made) { return "problem" + std::to_string(made.index); });

} // namespace
} // namespace hopmesh::tests
