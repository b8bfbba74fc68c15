// How far a motion is decided by its start: in results.csv, chart, budget and size.
#include "tests/support/cli_test.h"

#include <regex>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliSensitivity : public Cli {
 protected:
  std::vector<std::string> sensitivities(const std::string& folder) const {
    std::vector<std::string> files;
    for (const std::string& name : names_in(at(folder)))
      if (name.rfind("sensitivity-", 0) == 0 && name.find(".csv") == name.size() - 4) files.push_back(name);
    return files;
  }
};

// Words are no part of the reference's motion, its step is.
TEST_F(CliSensitivity, IsWorkedOutOnceForPointsOfOneMotion) {
  write_text(at("s.toml"), "scene = \"flag-225\"\nsteps = 8\ntimes = [0.05, 0.4]\n[axes]\n"
                           "\"formats.weight\" = [\"fixed<12,1,SC_RND,SC_SAT>\", "
                           "\"fixed<16,1,SC_RND,SC_SAT>\"]\n");
  good("sweep s.toml --out r -j 2");
  ASSERT_EQ(sensitivities("r").size(), 1u);
  const Table t = read_table(at("r") / "results.csv");
  const std::vector<double> early = t.numbers("sensitivity@0.05"), late = t.numbers("sensitivity@0.4");
  EXPECT_EQ(early[0], early[1]);
  EXPECT_GT(early[0], 0);
  EXPECT_GT(late[0], early[0]) << "the flag forgets its start";
  good("chart r --x reference_error@0.4 --y cycles");
  EXPECT_THAT(content_of(at("r") / "chart.svg"), HasSubstr(">sensitivity to the start's last place</text>"));
}

TEST_F(CliSensitivity, ADamagedOneIsSetAsideAndMadeAgain) {
  write_text(at("s.toml"),
             "scene = \"two-nodes\"\nsteps = 4\ntimes = [0.1]\n[axes]\n\"mesh.mass\" = [1.0]\n");
  good("sweep s.toml --out r");
  const std::string file = "r/" + sensitivities("r").at(0), whole = content_of(at(file));
  const std::string results = content_of(at("r/results.csv"));
  for (const std::string& text : {std::string("time\n"), std::string(), whole.substr(0, whole.size() - 3)}) {
    write_text(at(file), text);
    std::filesystem::remove(at("r/points/0.csv"));
    EXPECT_THAT(refused("sweep s.toml --out r"), HasSubstr("sensitivity-"));
    good("sweep s.toml --out r");
    EXPECT_EQ(content_of(at(file)), whole);
  }
}

TEST_F(CliSensitivity, IsAColumnOfTheBudget) {
  const Finished f = good("budget two-nodes --steps 4 --out b");
  EXPECT_THAT(f.out, HasSubstr("sensitivity"));
  for (const double s : read_table(at("b") / "budget.csv").numbers("sensitivity")) {
    EXPECT_GE(s, 0);
    EXPECT_LT(s, 1e-9);
  }
}

// The sentence names a time; for that time the error is one that can be asked for, a step later it is not.
TEST_F(CliSensitivity, SizeRefusesAnErrorThatTheStartDecides) {
  const std::string said = refused("size flag-225 --steps 30 --error 0.02 --out s", "--error: found 0.02");
  std::smatch part;
  static const std::regex longest(
      R"(the longest time for which 0\.02 m is decided is ([0-9.]+) s \(--steps (\d+)\))");
  ASSERT_TRUE(std::regex_search(said, part, longest)) << said;
  const int steps = std::stoi(part[2]);
  ASSERT_GT(steps, 0);
  ASSERT_LT(steps, 30);
  EXPECT_NEAR(std::stod(part[1]), 0.05 * steps, 1e-9);
  refused("size flag-225 --error 0.02 --out t --steps " + std::to_string(steps + 1), "--error: found 0.02");
}

TEST_F(CliSensitivity, SizeTellsWhatTheArrayAsGivenDoes) {
  const std::string line = "size banner --set mesh.grid.rows=4 --set mesh.grid.columns=5 --steps 5 ";
  EXPECT_THAT(good(line + "--error 1e-3 --out a").out, HasSubstr("The array as given, guarded: "));
  EXPECT_THAT(good(line + "--error 1e-3 --out a").out, HasSubstr(": meets the error"));
  const Finished coarse = good(line + "--array byte --error 1e-6 --out b");
  EXPECT_THAT(coarse.out, HasSubstr(": does not meet the error"));
  EXPECT_THAT(good(line + "--error 1e-3 --set array.lanes=9 --out c").out,
              ::testing::ContainsRegex("Silicon\n +custom +9 lanes [^\n]+\n +size +9 lanes "));
}

} // namespace
} // namespace hopmesh::tests
