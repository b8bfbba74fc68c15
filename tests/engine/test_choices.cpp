// Which core an engine takes, and what it says when it cannot have the one that was asked for.
#include "tests/engine/engine_bench.h"

#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "sim/engine/choose.h"
#include "sim/engine/kernels/fast_core.h"
#include "tests/support/complaint.h"

#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using engine::Engine;
using engine::Options;

const spec::Topology mesh = grid_topology(4, 5, true);

/// What the engine throws for this kernel on this array; empty if it takes it.
std::string refusal(const spec::ArraySpec& array, const std::string& kernel) {
  return complaint<std::invalid_argument>([&] { Engine(array, mesh, {1, kernel, 1}); });
}

TEST(EngineChoices, AKernelThatNobodyKnowsIsNamed) {
  for (const std::string name : {"sse", "AVX2", "", "auto ", "avx-512"})
    EXPECT_EQ(refusal(spec::default_array(), name), "no kernel is called " + name);
  spec::ArraySpec wide = spec::default_array();
  wide.formats.weight.width = 20; // and no other fault may hide that
  EXPECT_EQ(refusal(wide, "sse"), "no kernel is called sse");
}

class EveryKernel : public testing::TestWithParam<const char*> {};

TEST_P(EveryKernel, IsTheOneThatWorksOrIsRefused) {
  const std::string name = GetParam();
  const auto& here = kernels_here();
  if (std::find(here.begin(), here.end(), name) == here.end()) {
    EXPECT_EQ(refusal(spec::default_array(), name), "this processor cannot run kernel " + name);
    GTEST_SKIP() << "this processor has no kernel " << name;
  }
  const Engine e(spec::default_array(), mesh, {1, name, 1});
  EXPECT_EQ(e.kernel(), name);
}

INSTANTIATE_TEST_SUITE_P(Names, EveryKernel, testing::Values("generic", "portable", "avx2", "avx512"));

TEST(EngineChoices, EveryKernelThatHasANameIsTriedByThisFile) {
  EXPECT_THAT(engine::kernel_names(), testing::ElementsAre("auto", "generic", "portable", "avx2", "avx512"));
}

TEST(EngineChoices, AutoTakesTheBestKernelOrTheGenericCore) {
  EXPECT_EQ(Engine(spec::default_array(), mesh).kernel(), kernels_here().back());
  spec::ArraySpec wide = spec::default_array();
  wide.formats.weight.width = 17;
  EXPECT_STREQ(Engine(wide, mesh).kernel(), "generic");
}

TEST(EngineChoices, EveryPresetHasAKernel) {
  for (const spec::ArraySpec& a : spec::presets()) EXPECT_EQ(why_not_fast(a, mesh), "") << a.name;
}

/// Each reason once, from an array that breaks only that rule.
TEST(EngineChoices, AnArrayWithoutAKernelIsToldWhy) {
  using spec::Normaliser;
  const auto expect_reason = [](const std::string& reason, Normaliser normaliser, auto change) {
    spec::ArraySpec a = spec::default_array();
    a.normaliser = normaliser;
    change(a, a.formats);
    ASSERT_FALSE(spec::validate(a, mesh.most_taps())) << reason;
    EXPECT_EQ(refusal(a, "portable"), "kernel portable has no way for " + reason);
    EXPECT_EQ(refusal(a, "generic"), "");
    EXPECT_STREQ(Engine(a, mesh).kernel(), "generic") << reason;
  };
  using Spec = spec::ArraySpec;
  using Formats = spec::Formats;
  const auto reciprocal = Normaliser::reciprocal, divider = Normaliser::divider,
             prescaled = Normaliser::prescaled;
  expect_reason("weights of more than 16 bits", reciprocal, [](Spec&, Formats& f) { f.weight.width = 17; });
  expect_reason("links of more than 16 bits", divider, [](Spec&, Formats& f) { f.link.width = 17; });
  expect_reason("an accumulator that rounds", divider,
                [](Spec& a, Formats&) { a.exact_accumulator = false; });
  expect_reason("a bias finer than a product", divider, [](Spec&, Formats& f) {
    f.weight = {8, 1, spec::Rounding::rnd, spec::Overflow::sat};
    f.link = {8, 2, spec::Rounding::rnd, spec::Overflow::sat};
    f.bias = {16, 2, spec::Rounding::rnd, spec::Overflow::sat};
  });
  expect_reason("s times the reciprocal needs more than 62 bits", reciprocal, [](Spec& a, Formats& f) {
    a.reciprocal_bits = 32;
    f.bias = {32, 10, spec::Rounding::rnd, spec::Overflow::sat};
  });
  expect_reason("the reciprocal is coarser than the drive", reciprocal, [](Spec& a, Formats& f) {
    a.reciprocal_bits = 4;
    f.weight = f.bias = {4, 1, spec::Rounding::rnd, spec::Overflow::sat};
    f.link = {4, 3, spec::Rounding::rnd, spec::Overflow::sat};
    f.drive.width = 32;
  });
  expect_reason("SC_RND_CONV behind a divider", divider,
                [](Spec&, Formats& f) { f.drive.rounding = spec::Rounding::rnd_conv; });
  expect_reason("a quotient of more than 50 bits", divider, [](Spec&, Formats& f) { f.drive.width = 32; });
  for (auto overflow : {spec::Overflow::wrap, spec::Overflow::sat_zero})
    expect_reason("a drive that does not saturate, behind prescaled rows", prescaled,
                  [&](Spec&, Formats& f) { f.drive.overflow = overflow; });
  expect_reason("a drive finer than the accumulator", prescaled, [](Spec&, Formats& f) {
    f.weight = f.bias = f.link = {8, 2, spec::Rounding::rnd, spec::Overflow::sat};
    f.drive.width = 32;
  });
}

TEST(EngineChoices, ThreadsAreWhatWasAskedAndNeverNone) {
  for (std::size_t threads : {1u, 2u, 40u})
    EXPECT_EQ(Engine(spec::default_array(), mesh, {threads, "auto", 1}).threads(), threads);
  EXPECT_EQ(engine::useful_threads(mesh, 40), 1u); // small: one is best
  EXPECT_EQ(engine::useful_threads(grid_topology(100, 100, true), 2), 2u);
  EXPECT_EQ(engine::useful_threads(grid_topology(100, 100, true), 1), 1u);
}

/// More threads than there are blocks of cells, and than this machine has processors.
TEST(EngineChoices, ThreadsWithoutWorkDoNoHarm) {
  for (std::uint64_t seed : {800000u, 800001u, 800002u}) {
    const ArrayJob job = random_job(seed, 20);
    Engine e(job.array, job.topology, {40, "auto", 1});
    expect_run(e, job, run_slow_array(job));
  }
}

} // namespace
} // namespace hopmesh::tests
