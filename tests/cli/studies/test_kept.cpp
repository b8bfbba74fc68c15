// What studies and searches keep between starts: a damaged file is told by its line, set aside and made
// again, and what was ended from outside is no result.
#include "tests/support/cli_test.h"

#include "place.h"

#include <csignal>
#include <cstdlib>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliKept : public Cli {
 protected:
  /// Swaps a text of a file for another.
  void change(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = content_of(at(file));
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos) << file << ": " << text;
    write_text(at(file), text.replace(place, from.size(), to));
  }

  /// The line is refused for this file, and then makes anew what it left before.
  void expect_made_again(const std::string& line, const std::string& file, const std::string& results) const {
    const std::string before = content_of(at(results));
    EXPECT_THAT(refused(line), HasSubstr(file + ":")) << line;
    EXPECT_TRUE(std::filesystem::exists(at(file + ".damaged")));
    EXPECT_FALSE(std::filesystem::exists(at(file)));
    good(line);
    EXPECT_EQ(content_of(at(results)), before) << line;
  }

  std::string some(const std::string& folder, const std::string& start, const std::string& end) const {
    for (const std::string& name : names_in(at(folder)))
      if (name.rfind(start, 0) == 0 && name.find(end) != std::string::npos) return folder + '/' + name;
    ADD_FAILURE() << "no " << start << "..." << end << " in " << folder;
    return "";
  }

  const std::string map = "scene = \"two-nodes\"\nsteps = 10\n[axes]\n\"motion.time_step\" = [0.1, 0.2]\n"
                          "\"mesh.mass\" = [1.0, 2.0]\n";
};

TEST_F(CliKept, PointsThatAreNotAsTheyWere) {
  write_text(at("m.toml"), map);
  const std::string line = "stability m.toml --out r";
  good(line);
  const std::string results = "r/stability.csv";
  const std::vector<std::pair<const char*, const char*>> changes{
      {",stable,", ",stabel,"}, {"\n0,0.1,", "\n0,5,"}, {",engine,", ","},
      {"\n0,0.1,", "\n1,0.1,"}, {"point,", "pont,"},    {"\n", ""},
      {",finished,", ",,"},     {",10,", ",11,"}};
  for (const auto& [from, to] : changes) {
    change("r/points/0.csv", from, to);
    expect_made_again(line, "r/points/0.csv", results);
  }
  write_text(at("r/points/2.csv"), "");
  expect_made_again(line, "r/points/2.csv", results);
}

// A check does not help against somebody who makes it right again.
TEST_F(CliKept, PointsOfAnotherStudyWithAllChecksRight) {
  write_text(at("m.toml"), map);
  good("stability m.toml --out r");
  std::filesystem::copy_file(at("r/points/1.csv"), at("r/points/0.csv"),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THAT(refused("stability m.toml --out r"),
              HasSubstr("r/points/0.csv:2: point: found \"1\", expected 0"));
  good("stability m.toml --out r");
}

TEST_F(CliKept, SeveralDamagedFilesTakeOneMoreStart) {
  write_text(at("m.toml"), map);
  good("sweep m.toml --out r");
  for (const char* file : {"r/points/0.csv", "r/points/1.csv", "r/points/3.csv"}) change(file, "0", "7");
  EXPECT_THAT(refused("sweep m.toml --out r"), HasSubstr("(2 more files of this folder likewise)"));
  good("sweep m.toml --out r");
}

TEST_F(CliKept, TrialsThatAreNotAsTheyWere) {
  const std::string line =
      "size banner --set mesh.grid.rows=4 --set mesh.grid.columns=5 --steps 3 --error 0.001 --out r";
  good(line);
  const std::string trial = some("r/trials", "", ".csv");
  change(trial, "finished,", "finished,1e300");
  expect_made_again(line, trial, "r/size.csv");
}

TEST_F(CliKept, TruthsThatAreNotAsTheyWere) {
  const std::string line = "budget two-nodes --steps 3 --out r";
  good(line);
  const std::string table = some("r", "truth-", ".csv"), positions = some("r", "truth-", ".npy");
  for (const char* text : {"floor\n", "", "time,floor,positions,check\n", "\xff\xff"}) {
    write_text(at(table), text);
    expect_made_again(line, table, "r/budget.csv");
  }
  std::string bytes = content_of(at(positions));
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_text(at(positions), bytes);
  expect_made_again(line, table, "r/budget.csv");
  write_text(at(positions), bytes.substr(0, bytes.size() - 8));
  refused(line);
  good(line);
  write_text(at("s.toml"),
             "scene = \"two-nodes\"\nsteps = 10\ntimes = [0.1]\n[axes]\n\"mesh.mass\" = [1.0]\n");
  good("sweep s.toml --out s");
  std::filesystem::remove(at("s/points/0.csv"));
  write_text(at(some("s", "truth-", ".csv")), "floor\n");
  EXPECT_THAT(refused("sweep s.toml --out s"), HasSubstr(".csv:1: found other columns"));
  good("sweep s.toml --out s");
}

// What all points are measured against, beside the truth.
TEST_F(CliKept, ReferencesThatAreNotAsTheyWere) {
  write_text(at("s.toml"),
             "scene = \"two-nodes\"\nsteps = 10\ntimes = [0.1]\n[axes]\n\"mesh.mass\" = [1.0]\n");
  const std::string line = "sweep s.toml --out s";
  good(line);
  for (const char* kept : {"reference-", "sensitivity-"}) {
    const std::string table = some("s", kept, ".csv");
    std::filesystem::remove(at("s/points/0.csv"));
    write_text(at(table), "floor\n");
    EXPECT_THAT(refused(line), HasSubstr(table + ":1: found other columns"));
    good(line);
  }
  const std::string positions = some("s", "reference-", ".npy");
  std::string bytes = content_of(at(positions));
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_text(at(positions), bytes);
  std::filesystem::remove(at("s/points/0.csv"));
  EXPECT_THAT(refused(line), HasSubstr("damaged values"));
  good(line);
}

class CliWorkers : public CliKept {
 protected:
  CliWorkers() {
    write_text(at("slow.toml"), "scene = \"flag-225\"\nsteps = 60\nmethods = [\"systemc\"]\n[axes]\n"
                                "\"motion.time_step\" = [0.01, 0.02]\n");
  }
  /// A sweep of which a worker gets a signal, again and again, as often as told.
  Finished sweep_hit_by(const std::string& signal, int times, const std::string& folder) const {
    const std::string hits = "k=0; while [ $k -lt " + std::to_string(times) +
                             " ]; do sleep 0.4; w=$(pgrep -P $p | head -1); "
                             "[ -n \"$w\" ] && kill -" +
                             signal + " $w; k=$((k+1)); done; ";
    return run_shell(HOPMESH_PROGRAM " sweep slow.toml --out " + folder + " -j 1 & p=$!; " + hits + "wait $p",
                     around);
  }
};

TEST_F(CliWorkers, OneThatIsKilledIsTriedAgain) {
  const Finished f = sweep_hit_by("KILL", 1, "r");
  EXPECT_EQ(f.exit_code, 0) << f.err;
  EXPECT_EQ(content_of(at("r/results.csv")).find("crashed"), std::string::npos);
}

TEST_F(CliWorkers, OneThatIsAlwaysKilledLeavesItsPointMissing) {
  const Finished f = sweep_hit_by("KILL", 2, "r");
  EXPECT_EQ(f.exit_code, 1) << f.out << f.err;
  EXPECT_THAT(f.out + f.err, HasSubstr("ended from outside"));
  EXPECT_FALSE(std::filesystem::exists(at("r/results.csv")));
  good("sweep slow.toml --out r -j 2");
  EXPECT_EQ(content_of(at("r/results.csv")).find("crashed"), std::string::npos);
}

TEST_F(CliWorkers, OneThatIsAskedToStopLeavesItsPointMissing) {
  const Finished f = sweep_hit_by("TERM", 1, "r");
  EXPECT_EQ(f.exit_code, 1) << f.out << f.err;
  EXPECT_FALSE(std::filesystem::exists(at("r/results.csv")));
}

TEST_F(CliWorkers, SharesThatStartTogetherLoseNothing) {
  write_text(at("m.toml"), map);
  const Finished f = run_shell("for i in 0 1 2 3; do " HOPMESH_PROGRAM
                               " sweep m.toml --out r --share $i/4 -j 1 >/dev/null & done; wait",
                               around);
  EXPECT_EQ(f.err, "");
  EXPECT_EQ(names_in(at("r/points")).size(), 4u);
  good("sweep m.toml --out r");
}

// A stand-in for Slurm that runs all tasks at once.
TEST_F(CliWorkers, OneTaskOfSlurmFindsTheFolderFree) {
  std::filesystem::create_directory(at("bin"));
  write_text(at("bin/sbatch"), "#!/bin/sh\nfor last; do :; done\n"
                               "for a; do case $a in --array=0-*) n=${a#--array=0-};; esac; done\n"
                               "i=0; while [ $i -le $n ]; do SLURM_ARRAY_TASK_ID=$i sh \"$last\" || exit 1; "
                               "i=$((i+1)); done\n");
  std::filesystem::permissions(at("bin/sbatch"), std::filesystem::perms::owner_all);
  around.environment.emplace_back("PATH", at("bin").string() + ":" + std::getenv("PATH"));
  write_text(at("m.toml"), map);
  EXPECT_EQ(hopmesh("sweep m.toml --out r --executor slurm -j 1").exit_code, 0);
  std::filesystem::remove(at("r/points/2.csv"));
  EXPECT_EQ(hopmesh("sweep m.toml --out r --executor slurm -j 2").exit_code, 0);
}

TEST_F(CliWorkers, AFullDiskIsToldOnce) {
  write_text(at("m.toml"), map);
  around.largest_file = 300; // a point's row is longer
  const Finished f = hopmesh("sweep m.toml --out r -j 2");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_EQ(lines_of(f.err).size(), 1u) << f.err;
}

} // namespace
} // namespace hopmesh::tests
