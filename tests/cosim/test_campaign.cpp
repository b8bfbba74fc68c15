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

SharedBus soft(const ArrayJob& job, std::optional<Fault> fault = {}) {
  const auto port = std::make_shared<SoftArray>(job.array, job.topology, fault);
  return {port, &port->bus()};
}

Contestant healthy() {
  return {"healthy", [](const ArrayJob& job) { return soft(job); }};
}

// A bit of the first cell with two links flips in the second sweep.
Contestant faulty() {
  return {"faulty", [](const ArrayJob& job) {
            for (std::uint32_t c = 0; c < job.topology.cells(); ++c)
              if (job.topology.degree(c) >= 2)
                return soft(job, Fault{2, c * static_cast<std::uint32_t>(job.topology.neurons_per_cell)});
            return soft(job);
          }};
}

Contestant crashing() {
  return {"crashing", [](const ArrayJob& job) {
            if (job.topology.cells() >= 5) std::raise(SIGKILL);
            return soft(job);
          }};
}

class CampaignTest : public ::testing::Test {
 protected:
  CampaignResult run(const std::vector<Contestant>& contestants, std::uint64_t cases,
                     std::size_t children = 1) {
    CampaignPlan plan;
    plan.seed = 3, plan.cases = cases, plan.children = children;
    return run_campaign(
        contestants, plan, [this](std::uint64_t done) { told = done; }, stop);
  }
  ArrayJob shrunk(const std::vector<Contestant>& contestants, const Finding& finding) {
    return shrink(campaign_case(3, finding.number).job,
                  [&](const ArrayJob& job) { return differs_in_child(contestants, job); });
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
  const std::vector<Contestant> all{healthy(), healthy(), faulty()};
  const CampaignResult r = run(all, 300);
  ASSERT_TRUE(r.finding);
  EXPECT_EQ(r.finding->contestant, 2u);
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
  EXPECT_EQ(check_answers("f", reader, again, *soft(small), lines), "");
  VectorReader second(file.string());
  second.next(again);
  EXPECT_THAT(check_answers("f", second, again, *faulty().make(small), lines),
              HasSubstr("case found, sweep 2"));
  std::filesystem::remove_all(file.parent_path());
}

TEST_F(CampaignTest, ACrashNamesItsCaseAndShrinksToo) {
  const std::vector<Contestant> all{healthy(), crashing()};
  const CampaignResult r = run(all, 100);
  ASSERT_TRUE(r.finding);
  EXPECT_EQ(r.finding->contestant, 0u);
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
  Contestant refusing{"refusing", [](const ArrayJob& job) {
                        const auto port = std::make_shared<SoftArray>(job.array, job.topology);
                        port->refuse = true;
                        return SharedBus(port, &port->bus());
                      }};
  const CampaignResult r = run({healthy(), refusing}, 10);
  ASSERT_TRUE(r.finding);
  EXPECT_EQ(r.finding->number, 0u);
  EXPECT_THAT(r.finding->text, HasSubstr("the array's bus answered with error -1"));
}

TEST_F(CampaignTest, StopsWhenAskedAndSaysWhereToGoOn) {
  stop = true;
  const CampaignResult r = run({healthy(), healthy()}, 1000);
  EXPECT_TRUE(r.interrupted);
  EXPECT_EQ(r.next, 0u);
  EXPECT_FALSE(r.finding);
}

TEST(InChild, TellsHowItEnded) {
  EXPECT_EQ(in_child([] { return 7; }, 10), 7);
  EXPECT_EQ(in_child([]() -> int { throw std::runtime_error("no"); }, 10), 98);
  EXPECT_EQ(in_child([] { return std::raise(SIGKILL); }, 10), 100 + SIGKILL);
  EXPECT_EQ(in_child(
                [] {
                  while (pause() == -1) {
                  }
                  return 0;
                },
                1),
            100 + SIGALRM); // who hangs is ended
}

} // namespace
} // namespace hopmesh::tests
