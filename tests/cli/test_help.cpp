// --help, --version, and the promise that every example in a help text runs.
#include "sim/levels/level.h"
#include "tests/support/cli_test.h"

#include <regex>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliHelp : public Cli {
 protected:
  /// The command behind "Example:", without the program's name.
  static std::string example_in(const std::string& help) {
    static const std::regex shape(R"(Example:\n  hopmesh ([^\n]+))");
    std::smatch part;
    return std::regex_search(help, part, shape) ? part[1].str() : "";
  }

  std::vector<std::string> verbs() const {
    std::vector<std::string> names;
    static const std::regex verb(R"(\n  ([a-z]+) {3,})");
    const std::string help = good("--help").out;
    for (std::sregex_iterator at(help.begin(), help.end(), verb), end; at != end; ++at)
      names.push_back((*at)[1]);
    return names;
  }
};

TEST_F(CliHelp, NamesEveryVerb) {
  for (const char* verb : {"run",    "compare", "network",   "solvers", "info",     "vectors", "fuzz",
                           "sweep",  "chart",   "stability", "solve",   "problem",  "budget",  "size",
                           "scenes", "presets", "levels",    "studies", "problems", "help"})
    EXPECT_THAT(verbs(), ::testing::Contains(verb));
}

TEST_F(CliHelp, IsToldInEveryWayOfAsking) {
  const std::string help = good("--help").out;
  EXPECT_EQ(good("").out, help);
  EXPECT_EQ(good("help").out, help);
  EXPECT_EQ(good("help run").out, good("run --help").out);
}

TEST_F(CliHelp, FitsATerminalAndHasNoNoise) {
  for (const std::string& verb : verbs()) {
    const std::string help = good(verb + " --help").out;
    EXPECT_THAT(help, ::testing::Not(HasSubstr("Excludes"))) << verb;
    for (const std::string& line : lines_of(help.substr(0, help.find("Example:"))))
      EXPECT_LE(line.size(), 101u) << verb << ": " << line;
  }
  EXPECT_THAT(good("run --help").out, HasSubstr("(default engine)"));
  EXPECT_THAT(good("size --help").out, HasSubstr("(required)"));
}

TEST_F(CliHelp, ListsNameWhatThereIs) {
  const auto names_in_list = [this](const char* verb) {
    std::vector<std::string> names;
    for (const std::string& line : lines_of(good(verb).out)) names.push_back(line.substr(0, line.find(' ')));
    return names;
  };
  EXPECT_THAT(names_in_list("scenes"), ::testing::IsSupersetOf({"flag-400", "banner", "two-nodes"}));
  EXPECT_THAT(names_in_list("presets"),
              ::testing::ElementsAre("guarded", "descent", "prescaled", "byte", "folded", "descent-projected",
                                     "descent-momentum"));
  EXPECT_EQ(names_in_list("levels"), levels::level_names());
  EXPECT_THAT(names_in_list("studies"), ::testing::IsSupersetOf({"first-widths", "banner-bits"}));
  EXPECT_THAT(names_in_list("problems"), ::testing::IsSupersetOf({"queens-8", "box-random-100"}));
  for (const std::string& scene : names_in_list("scenes"))
    EXPECT_THAT(good("scenes").out, ::testing::ContainsRegex("\n?" + scene + " +[A-Z].*[.:]\n"));
}

TEST_F(CliHelp, OfTheProgramHasAnExampleThatRuns) {
  const std::string example = example_in(good("--help").out);
  ASSERT_EQ(example, "run flag-400 --out out/flag-400");
  good(example + " --steps 2"); // two steps of its 400: the rest is time
  EXPECT_EQ(fault_of_results(at("out/flag-400"), 2), "");
}

TEST_F(CliHelp, OfEveryVerbHasAnExampleThatRuns) {
  for (const std::string& verb : verbs()) {
    const std::string example = example_in(good(verb + " --help").out);
    ASSERT_EQ((example + ' ').rfind(verb + ' ', 0), 0u) << verb << ": " << example;
    EXPECT_NE(good(example).out, "") << example;
  }
}

TEST_F(CliHelp, OfEveryVerbTellsEveryFlag) {
  const auto expect_flags = [this](const std::string& verb, const std::vector<std::string>& flags) {
    const std::string help = good(verb + " --help").out;
    for (const std::string& flag : flags) EXPECT_THAT(help, HasSubstr("--" + flag)) << verb;
    for (const char* flag : {"--array", "--set", "SCENE"}) EXPECT_THAT(help, HasSubstr(flag)) << verb;
  };
  expect_flags("run", {"level", "steps", "out", "no-check", "checkpoint-every", "resume", "wave",
                       "wave-window", "wave-cells"});
  expect_flags("compare", {"levels", "steps"});
  expect_flags("network", {"step", "out"});
  expect_flags("solvers", {"step", "gap", "max-sweeps", "cold", "still", "time-step", "out"});
  expect_flags("info", {"toml"});
  expect_flags("budget", {"steps", "time", "out"});
  expect_flags("size", {"error", "against", "time-per-step", "steps", "out"});
  expect_flags("vectors", {"step", "sweeps", "random", "seed", "neurons", "format", "taps", "out", "blank",
                           "check", "level"});
}

TEST_F(CliHelp, OfStudiesTellsEveryFlag) {
  for (const char* verb : {"sweep", "stability"}) {
    const std::string help = good(std::string(verb) + " --help").out;
    for (const char* flag : {"STUDY", "--out", "-j", "--executor", "--share"})
      EXPECT_THAT(help, HasSubstr(flag));
  }
  for (const char* flag : {"DIR", "--x", "--y"}) EXPECT_THAT(good("chart --help").out, HasSubstr(flag));
}

TEST_F(CliHelp, OfNetworksTellsEveryFlag) {
  const std::string help = good("solve --help").out;
  for (const char* flag : {"BIAS", "--start", "--rule", "--asymmetric", "--level", "--array", "--set",
                           "--sweeps", "--threshold", "--seed", "--out"})
    EXPECT_THAT(help, HasSubstr(flag));
  for (const char* flag : {"NAME", "--seed", "--out"})
    EXPECT_THAT(good("problem --help").out, HasSubstr(flag));
}

TEST_F(CliHelp, VersionNamesVersionCommitAndCompiler) {
  EXPECT_THAT(good("--version").out,
              ::testing::MatchesRegex("hopmesh [0-9]+\\.[0-9]+\\.[0-9]+ \\(.+, .+, .+\\)\n"));
}

} // namespace
} // namespace hopmesh::tests
