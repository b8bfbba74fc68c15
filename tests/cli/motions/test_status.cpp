// How honest a run is about its end: steps that did not come to rest, time on hardware, undecided outputs.
#include "tests/support/cli_test.h"

namespace hopmesh::tests {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

class CliStatus : public Cli {};

TEST_F(CliStatus, StepsThatEndedAtTheirLimitAreTold) {
  const Finished f = good("run flag-225 --steps 6 --set relax.max_sweeps=4 --out r");
  const std::string clause = "6 of 6 steps ended at max_sweeps";
  EXPECT_THAT(f.out, HasSubstr("flag-225: All 6 steps done. " + clause));
  EXPECT_THAT(f.out, EndsWith("Not at rest: " + clause + ".\n"));
  const auto stats = read_json(at("r") / "stats.json");
  EXPECT_EQ(stats["status"], "doubtful");
  EXPECT_THAT(std::string(stats["sentence"]), HasSubstr(clause));
  const std::string page = content_of(at("r") / "report.html");
  EXPECT_THAT(page, HasSubstr("\"rested\":false"));
  EXPECT_THAT(page, HasSubstr(clause));
}

TEST_F(CliStatus, AtRestARunIsGood) {
  const Finished f = good("run banner --steps 3 --out r");
  EXPECT_THAT(f.out, Not(HasSubstr("Not at rest")));
  EXPECT_EQ(read_json(at("r") / "stats.json")["status"], "good");
  EXPECT_THAT(content_of(at("r") / "report.html"), HasSubstr("\"rested\":true"));
}

TEST_F(CliStatus, ARivalRelaxesNothing) {
  EXPECT_THAT(good("run two-nodes --level rk4 --steps 3 --out r").out, Not(HasSubstr("Not at rest")));
  EXPECT_EQ(read_json(at("r") / "stats.json")["status"], "good");
}

TEST_F(CliStatus, ADivergedRunIsBad) {
  EXPECT_EQ(hopmesh("run two-nodes --set probe.gamma=1e9 --out r").exit_code, 1);
  EXPECT_EQ(read_json(at("r") / "stats.json")["status"], "bad");
}

TEST_F(CliStatus, TimeOnHardwareIsOfArrayAndBus) {
  const Finished f = good("run two-nodes --steps 4 --set array.clock_mhz=200 --out r");
  const auto stats = read_json(at("r") / "stats.json");
  const double array = stats["array_cycles"], bus = stats["bus_cycles"];
  EXPECT_DOUBLE_EQ(stats["hardware_seconds"], (array + bus) / 200e6);
  EXPECT_THAT(f.out, HasSubstr(std::to_string(static_cast<int>(100 * bus / (array + bus) + 0.5)) +
                               " % of it on the bus (the host's own part is not known)"));
  results_of("two-nodes --steps 4 --level reference", "d");
  EXPECT_FALSE(read_json(at("d") / "stats.json").contains("hardware_seconds"));
}

TEST_F(CliStatus, UtilisationIsOfMultiplierCycles) {
  good("run two-nodes --steps 4 --out r");
  const auto stats = read_json(at("r") / "stats.json");
  const double array = stats["array_cycles"], bus = stats["bus_cycles"], sweeps = stats["sweeps"];
  // Three multipliers take 9 weights a sweep, which is 22 cycles; a run begins with START and 22 of prepare.
  EXPECT_DOUBLE_EQ(stats["utilisation"], 9 * sweeps / (3 * array));
  EXPECT_DOUBLE_EQ(stats["utilisation_with_bus"], 9 * sweeps / (3 * (array + bus)));
  const auto& timeline = stats["timeline"];
  EXPECT_EQ(timeline["bus"], bus);
  EXPECT_EQ(timeline["array_prepare"], 4 * 23);
  EXPECT_EQ(timeline["array_sweeps"], 22 * sweeps);
  EXPECT_EQ(timeline["array_waits_for_bus"], bus);
  EXPECT_EQ(timeline["bus_waits_for_array"], array);
  EXPECT_TRUE(timeline["host_with_both_idle"].is_null()) << "nobody knows it";
  const std::string page = content_of(at("r") / "report.html");
  EXPECT_THAT(page, HasSubstr("Who works when"));
  EXPECT_THAT(page, HasSubstr("All 4 steps"));
  results_of("two-nodes --steps 4 --level reference", "d");
  EXPECT_FALSE(read_json(at("d") / "stats.json").contains("utilisation"));
  EXPECT_THAT(content_of(at("d") / "report.html"), Not(HasSubstr("Who works when")));
}

// A flat flag may leave its plane to either side: outputs are as far apart as can be, energies are not.
TEST_F(CliStatus, CompareTellsWhichStepsDecideNothing) {
  const Finished flag = good("compare flag-225 --levels reference,engine --steps 5");
  EXPECT_THAT(flag.out, HasSubstr("of 5 steps (first 1, last 4) leave outputs undecided"));
  EXPECT_THAT(flag.out, HasSubstr("so either answer is as good"));
  EXPECT_THAT(flag.out, HasSubstr("in all other steps outputs differ by at most "));
  EXPECT_THAT(flag.out, HasSubstr("of 5 steps ended at max_sweeps."));
  EXPECT_THAT(good("compare banner --levels reference,engine --steps 3").out, Not(HasSubstr("undecided")));
}

} // namespace
} // namespace hopmesh::tests
