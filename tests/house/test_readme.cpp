// What README and the pages of docs/use promise: commands run, the tour ends in a success, every flag of the
// program is tried or told.
#include "tests/house/tree.h"
#include "tests/support/program.h"

#include "place.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <regex>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

// ---- flags

// README and docs/use: what a user reads and types.
std::vector<TreeFile> pages_of_users() {
  std::vector<TreeFile> pages;
  for (const TreeFile& page : tree_files({".md"}))
    if (page.path == "README.md" || starts_with(page.path, "docs/use/")) pages.push_back(page);
  return pages;
}

std::string all_words_of_users() {
  std::string words;
  for (const TreeFile& page : pages_of_users()) words += page.text;
  for (const TreeFile& file : tree_files({".cpp", ".h"}))
    if (starts_with(file.path, "tests/cli/")) words += file.text;
  return words;
}

std::vector<std::string> verbs() {
  return matches(run_shell(HOPMESH_PROGRAM " --help").out, "\n  ([a-z]+) {3,}");
}

std::string help_of(const std::string& verb) {
  return run_shell(HOPMESH_PROGRAM " " + verb + " --help").out;
}

TEST(Readme, everyFlagIsTriedOrTold) {
  ASSERT_GE(verbs().size(), 4u) << "no verbs found: is the test blind?";
  const std::string words = all_words_of_users();
  for (const std::string& verb : verbs())
    for (const std::string& flag : matches(help_of(verb), "\n  (?:-\\w,)?(--[\\w-]+)"))
      EXPECT_TRUE(std::regex_search(words, std::regex(flag + "(?![\\w-])")))
          << "hopmesh " << verb << " " << flag << ": in no test of tests/cli and on no page of users";
}

// ---- commands

// Lines of ```sh blocks, comments off and continued lines joined.
std::vector<std::string> shell_commands(const std::string& page) {
  std::vector<std::string> commands;
  std::string whole;
  bool inside = false;
  for (std::string line : lines_of(page)) {
    if (starts_with(line, "```")) {
      inside = line == "```sh";
      continue;
    }
    if (!inside) continue;
    line = std::regex_replace(line, std::regex("(^|\\s)#.*"), "");
    const bool goes_on = !line.empty() && line.back() == '\\';
    whole += goes_on ? line.substr(0, line.size() - 1) : line;
    if (goes_on) continue;
    if (whole.find_first_not_of(' ') != std::string::npos) commands.push_back(whole);
    whole.clear();
  }
  return commands;
}

bool runs_the_program(const std::string& command) {
  return starts_with(command, "build/hopmesh ") || starts_with(command, "hopmesh ");
}

// A command with three steps only: whether it works shows in the first.
std::string shortened(const std::string& command) {
  static const std::regex long_verb("hopmesh (run|compare) ");
  if (command.find("--steps") != std::string::npos) return command;
  return std::regex_replace(command, long_verb, "hopmesh $1 --steps 3 ");
}

// A folder that looks like the tree after ./demo.
class Commands : public testing::Test {
 protected:
  Commands() {
    for (const char* room : {"docs", "firmware", "rtl_model", "sim", "tests"})
      fs::create_symlink(fs::path(HOPMESH_SOURCE_DIR) / room, folder_ / room);
    fs::create_directory(folder_ / "build");
    fs::create_symlink(HOPMESH_PROGRAM, folder_ / "build/hopmesh");
  }

  std::string expect_to_run(const std::string& command) {
    Surroundings around;
    around.folder = folder_.path();
    const Finished f = run_shell("export PATH=$PWD/build:$PATH && " + shortened(command), around);
    EXPECT_EQ(f.exit_code, 0) << command << "\n" << f.out << f.err;
    return f.out;
  }

  Folder folder_;
};

TEST_F(Commands, ofThePagesOfUsersRun) {
  int tried = 0;
  for (const TreeFile& page : pages_of_users())
    for (const std::string& command : shell_commands(page.text))
      if (runs_the_program(command)) ++tried, expect_to_run(command);
  EXPECT_GE(tried, 15) << "fewer than the tour has: is the test blind?";
}

TEST_F(Commands, ofTheTourAreFifteenAndEndInASuccess) {
  const std::vector<std::string> tour = shell_commands(text_of("docs/use/tour.md"));
  ASSERT_EQ(tour.size(), 15u);
  const std::string told = expect_to_run(tour.back());
  EXPECT_NE(told.find(": a solution"), std::string::npos) << told;
}

TEST_F(Commands, ofTheHelpRun) {
  for (const std::string& verb : verbs()) {
    const std::vector<std::string> examples = matches(help_of(verb), "\n  (hopmesh [^\n]+)");
    EXPECT_FALSE(examples.empty()) << verb;
    for (const std::string& command : examples) expect_to_run(command);
  }
}

// Whatever else the README asks a reader to type is a file that can be run.
TEST(Readme, scriptsExist) {
  for (const std::string& command : shell_commands(text_of("README.md"))) {
    const std::string word = command.substr(0, command.find(' '));
    if (!starts_with(word, "./")) continue;
    const fs::path script = fs::path(HOPMESH_SOURCE_DIR) / word;
    EXPECT_TRUE(fs::exists(script)) << command;
  }
}

} // namespace
} // namespace hopmesh::tests
