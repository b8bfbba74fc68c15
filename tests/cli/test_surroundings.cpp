// What surrounds a command: streams that are closed or full, names in odd bytes, limits of the system,
// folders that are gone. None of it may lose a result, or pass for success.
#include "tests/support/cli_test.h"

#include "place.h"

#include <csignal>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliSurroundings : public Cli {
 protected:
  /// The program under what a shell makes of its streams and limits.
  Finished shell(const std::string& before, const std::string& words, const std::string& after = "") const {
    return run_shell(before + " " HOPMESH_PROGRAM " " + words + " " + after, around);
  }

  const std::string checkpoints = "run two-nodes --steps 12 --checkpoint-every 4 --out ";
};

TEST_F(CliSurroundings, ClosedStreamsStayOutOfTheResults) {
  good("run two-nodes --steps 12 --out whole");
  EXPECT_EQ(shell("", checkpoints + "a", "<&- 2>&-").exit_code, 0);
  EXPECT_EQ(shell("", checkpoints + "b", "<&- >&- 2>&-").exit_code, 0);
  for (const char* folder : {"a", "b"}) expect_same_bits(at("whole"), at(folder));
}

TEST_F(CliSurroundings, AFullStderrLosesNoRun) {
  EXPECT_EQ(shell("", checkpoints + "r", "2>/dev/full").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(at("r") / "report.html"));
  const Finished mistake = shell("", "run nosuch", "2>/dev/full");
  EXPECT_EQ(mistake.exit_code, 2);
  EXPECT_EQ(mistake.out, "");
}

TEST_F(CliSurroundings, OutputThatNobodyGotIsToldAndNoSuccess) {
  for (const char* words : {"info two-nodes --toml", "--help", "--version", "scenes", "help run",
                            "compare two-nodes --steps 1", "run two-nodes --steps 1 --out r"}) {
    const Finished f = shell("", words, ">/dev/full");
    EXPECT_EQ(f.exit_code, 2) << words;
    EXPECT_THAT(f.err, HasSubstr("hopmesh: stdout: ")) << words;
    EXPECT_EQ(lines_of(f.err).size(), 1u) << f.err;
  }
}

TEST_F(CliSurroundings, ATerminalThatIsGoneLosesNoRun) {
  around.terminal = true;
  Program run(words_of("run flag-225 --level systemc --no-check --steps 60 --out r"), around);
  ASSERT_TRUE(run.wait_for("step 1 of"));
  run.send(SIGHUP); // as the terminal does when its window is closed
  EXPECT_EQ(run.finish().exit_code, 130);
  EXPECT_TRUE(std::filesystem::exists(at("r") / "checkpoint"));
  around.terminal = false;
  EXPECT_EQ(hopmesh("run --resume r").exit_code, 0);
}

TEST_F(CliSurroundings, ASighupThatIsIgnoredStaysSo) {
  const Finished f = run_shell("trap '' HUP; " HOPMESH_PROGRAM
                               " run flag-225 --level systemc --no-check --steps 20 --out r & "
                               "p=$!; sleep 0.3; kill -HUP $p; wait $p",
                               around);
  EXPECT_EQ(f.exit_code, 0) << f.err;
}

// Names get into JSON, TOML and SVG; what has no place there is refused before the work.
TEST_F(CliSurroundings, NamesThatAreNoUtf8AreRefusedAtOnce) {
  const std::string odd = "b\xff";
  good("info two-nodes --toml");
  write_text(at(odd + ".toml"), hopmesh("info two-nodes --toml").out);
  write_text(at(odd + ".mtx"), "%%MatrixMarket matrix coordinate real symmetric\n2 2 1\n2 1 1\n");
  const std::vector<std::vector<std::string>> lines{
      {"run", "./" + odd + ".toml", "--out", "r"},
      {"run", "two-nodes", "--set", "name=" + odd, "--out", "r"},
      {"run", "two-nodes", "--set", "mesh.file=" + odd + ".obj", "--out", "r"},
      {"run", "two-nodes", "--array", odd + ".toml", "--out", "r"},
      {"solve", "./" + odd + ".mtx", "--out", "r"},
      {"sweep", "./" + odd + ".toml", "--out", "r"}};
  for (const auto& words : lines) {
    const Finished f = run_program(words, around);
    EXPECT_EQ(f.exit_code, 2) << words[0];
    EXPECT_THAT(f.err, HasSubstr("expected UTF-8"));
    EXPECT_THAT(f.err, HasSubstr("\\xFF"));
    EXPECT_FALSE(std::filesystem::exists(at("r")));
  }
}

TEST_F(CliSurroundings, AFolderMayBeCalledAnything) {
  const std::string odd = "r\xff";
  EXPECT_EQ(run_program({"run", "two-nodes", "--steps", "2", "--out", odd}, around).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(at(odd) / "manifest.json"));
  EXPECT_TRUE(std::filesystem::create_directory(at("d\xff")));
  write_text(at("two.obj"), "v 0 0 0\nv 1 0 0\nl 1 2\n");
  const Finished f = run_shell("cd 'd\xff' && cp ../two.obj . && " HOPMESH_PROGRAM
                               " run two-nodes --set mesh.file=two.obj --out ../q",
                               around);
  EXPECT_NE(f.exit_code, 1) << f.err; // a path that is no UTF-8 is a mistake, no defect
}

TEST_F(CliSurroundings, ACurrentFolderThatIsGoneIsASentence) {
  const Finished f = shell("mkdir gone; cd gone; rmdir ../gone;", "info two-nodes --set mesh.file=x.obj");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("mesh.file: found a current folder that is gone"));
}

TEST_F(CliSurroundings, MemoryThatIsRefusedIsASentence) {
  const Finished f =
      shell("ulimit -v 200000;", "info two-nodes --set 'mesh.grid={rows=2000,columns=2000,pitch=1}'");
  if (f.signal != 0 || f.exit_code == 127) GTEST_SKIP() << "the program does not start in so little";
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_THAT(f.err, HasSubstr("hopmesh: memory: found less"));
  EXPECT_EQ(lines_of(f.err).size(), 1u);
}

TEST_F(CliSurroundings, TheLinkInThePlaceOfAPartIsNotFollowed) {
  write_text(at("victim"), "precious");
  std::filesystem::create_directory(at("r"));
  std::filesystem::create_symlink("../victim", at("r") / "positions.npy.part");
  EXPECT_THAT(refused("run two-nodes --steps 2 --out r"),
              HasSubstr("positions.npy.part: found a symbolic link"));
  EXPECT_EQ(content_of(at("victim")), "precious");
}

TEST_F(CliSurroundings, KeysOfAnyLengthAreToldShort) {
  const std::string deep = "a" + [] {
    std::string parts;
    for (int k = 0; k < 30'000; ++k) parts += ".a";
    return parts;
  }();
  for (const std::string& key : {deep, "a." + std::string(100'000, 'b')}) {
    const Finished f = run_program({"info", "two-nodes", "--set", key + "=1"}, around);
    EXPECT_EQ(f.exit_code, 2);
    EXPECT_LT(f.err.size(), 600u);
    EXPECT_LT(f.seconds, 5);
  }
}

TEST_F(CliSurroundings, WithoutSbatchThereIsASentence) {
  around.environment.emplace_back("PATH", "/nowhere");
  write_text(at("s.toml"), "scene = \"two-nodes\"\nsteps = 2\n");
  refused("sweep s.toml --out r --executor slurm", "--executor: found no sbatch on the PATH");
}

} // namespace
} // namespace hopmesh::tests
