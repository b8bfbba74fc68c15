// The campaign in its child processes, with levels that are wrong, crash or hang to order: what it finds, how
// small it gets, and the file that shows it again.
#include "sim/cosim/finding.h"
#include "sim/cosim/random_job.h"
#include "sim/cosim/shrink.h"
#include "sim/input/input_error.h"
#include "tests/support/soft_array.h"

#include <csignal>
#include <gmock/gmock.h>

namespace hopmesh::tests {
namespace {

using namespace cosim;
using ::testing::HasSubstr;

std::unique_ptr<levels::ArrayPort> soft(const spec::ArraySpec& array, const spec::Topology& topology,
                                        std::optional<Fault> fault = {}) {
  return std::make_unique<SoftArray>(array, topology, fault);
}

Way healthy() {
  return {"healthy", [](const auto& array, const auto& topology) { return soft(array, topology); }};
}

// A bit of the first cell with two links flips in the second sweep.
Way faulty() {
  return {
      "faulty", [](const auto& array, const auto& topology) {
        for (std::uint32_t c = 0; c < topology.cells(); ++c)
          if (topology.degree(c) >= 2)
            return soft(array, topology, Fault{2, c * static_cast<std::uint32_t>(topology.neurons_per_cell)});
        return soft(array, topology);
      }};
}

Way crashing() {
  return {"crashing", [](const auto& array, const auto& topology) {
            if (topology.cells() >= 5) std::raise(SIGKILL);
            return soft(array, topology);
          }};
}

class CampaignTest : public ::testing::Test {
 protected:
  CampaignResult run(const Ways& ways, std::uint64_t cases, std::size_t children = 1) {
    CampaignPlan plan;
    plan.seed = 3, plan.cases = cases, plan.children = children;
    return run_campaign(
        ways, plan, [this](std::uint64_t done) { told = done; }, stop);
  }
  ArrayJob shrunk(const Ways& ways, const Finding& finding) {
    return shrink(campaign_case(3, finding.number).job,
                  [&](const ArrayJob& job) { return differs_in_child(ways, job); });
  }
  std::atomic<bool> stop{false};
  std::uint64_t told = 0;
};

TEST_F(CampaignTest, EqualLevelsAgreeInEveryCase) {
  const CampaignResult r = run({healthy(), healthy()}, 250, 2); // two batches
  EXPECT_FALSE(r.finding) << r.finding->text;
  EXPECT_EQ(r.cases, 250u);
  EXPECT_EQ(r.next, 250u);
  EXPECT_EQ(told, 250u);
}

TEST_F(CampaignTest, ACaseIsAFunctionOfSeedAndNumber) {
  const auto a = campaign_case(3, 41).job, b = campaign_case(3, 41).job, c = campaign_case(3, 42).job,
             d = campaign_case(4, 41).job;
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(describe(a), describe(b));
  EXPECT_NE(describe(a), describe(c));
  EXPECT_NE(describe(a), describe(d));
}

TEST_F(CampaignTest, AFaultIsFoundShrunkAndWrittenSoThatItShowsAgain) {
  const Ways all{healthy(), healthy(), faulty()};
  const CampaignResult r = run(all, 300);
  ASSERT_TRUE(r.finding);
  EXPECT_EQ(r.finding->way, 2u);
  EXPECT_THAT(r.finding->text, HasSubstr("healthy and faulty: "));
  const auto two = involved(all, *r.finding);
  ASSERT_EQ(two.size(), 2u);
  const ArrayJob small = shrunk(two, *r.finding);
  EXPECT_TRUE(differs_in_child(two, small));
  EXPECT_EQ(small.topology.cells(), 3u);
  EXPECT_EQ(small.topology.links(), 2u);
  EXPECT_EQ(small.max_sweeps, 2u);

  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "hopmesh-finding" / "case.txt";
  write_finding(file, {"found", small}, two, {r.finding->text});
  VectorReader reader(file.string());
  VectorCase again;
  ASSERT_TRUE(reader.next(again));
  EXPECT_TRUE(differs_in_child(two, again.job));
  std::uint64_t lines = 0;
  EXPECT_EQ(check_answers("f", reader, again, soft(small.array, small.topology)->bus(), lines), "");
  VectorReader second(file.string());
  second.next(again);
  EXPECT_THAT(check_answers("f", second, again, faulty().make(small.array, small.topology)->bus(), lines),
              HasSubstr("case found, sweep 2"));
  std::filesystem::remove_all(file.parent_path());
}

TEST_F(CampaignTest, ACrashNamesItsCaseAndShrinksToo) {
  const Ways all{healthy(), crashing()};
  const CampaignResult r = run(all, 100);
  ASSERT_TRUE(r.finding);
  EXPECT_EQ(r.finding->way, 0u);
  EXPECT_THAT(r.finding->text, HasSubstr("killed by signal 9"));
  EXPECT_GE(campaign_case(3, r.finding->number).job.topology.cells(), 5u);
  for (std::uint64_t k = 0; k < r.finding->number; ++k)
    EXPECT_LT(campaign_case(3, k).job.topology.cells(), 5u) << k;
  const ArrayJob small = shrunk(all, *r.finding);
  EXPECT_EQ(small.topology.cells(), 5u);
  EXPECT_EQ(small.topology.links(), 0u);

  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "hopmesh-crash.txt";
  write_finding(file, {"crash", small}, {crashing(), healthy()}, {"a crash"}); // no answers can be had
  VectorReader reader(file.string());
  VectorCase blank;
  ASSERT_TRUE(reader.next(blank));
  EXPECT_THROW(reader.answer(), input::InputError);
  std::filesystem::remove(file);
}

TEST_F(CampaignTest, AFaultOfTheBusIsAFindingInWords) {
  const Way refusing{"refusing", [](const auto& array, const auto& topology) {
                       auto port = std::make_unique<SoftArray>(array, topology);
                       port->refuse = true;
                       return port;
                     }};
  const CampaignResult r = run({healthy(), refusing}, 10);
  ASSERT_TRUE(r.finding);
  EXPECT_EQ(r.finding->number, 0u);
  EXPECT_THAT(r.finding->text, HasSubstr("the bus refused a transfer"));
}

TEST_F(CampaignTest, StopsWhenAskedAndSaysWhereToGoOn) {
  stop = true;
  const CampaignResult r = run({healthy(), healthy()}, 1000);
  EXPECT_TRUE(r.interrupted);
  EXPECT_EQ(r.next, 0u);
  EXPECT_FALSE(r.finding);
}

} // namespace
} // namespace hopmesh::tests
