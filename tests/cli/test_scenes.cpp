// Every shipped scene runs, at reference and systemc.
#include "tests/cli/cli_test.h"

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const std::string& file : names_in(HOPMESH_SOURCE_DIR "/sim/scenes"))
    names.push_back(fs::path(file).stem());
  return names;
}

class CliScene : public Cli, public ::testing::WithParamInterface<std::string> {};
class CliSceneFile : public Cli {};

TEST_P(CliScene, RunsAFewStepsAtEveryLevel) {
  const Finished info = hopmesh("info " + GetParam());
  if (info.exit_code == 2 && info.err.find("mesh.file: found no file") != std::string::npos)
    GTEST_SKIP() << info.err; // its mesh is not part of this tree
  ASSERT_EQ(info.exit_code, 0) << info.err;
  for (const char* level : {"reference", "systemc"}) {
    const fs::path r = results_of(GetParam() + " --steps 2 --no-check --level " + level, level);
    EXPECT_EQ(fault_of_results(r, 2, std::string(level) != "reference"), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, CliScene, ::testing::ValuesIn(shipped()), [](const auto& made) {
  std::string name = made.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

TEST_F(CliSceneFile, WithoutItsMeshSaysWhereToPutIt) {
  write_text(at("s.toml"), "[mesh]\nfile = \"cow.obj\"\n");
  const Finished f = hopmesh("run s.toml");
  EXPECT_EQ(f.exit_code, 2);
  EXPECT_EQ(lines_of(f.err).size(), 1u) << f.err;
  EXPECT_THAT(f.err, ::testing::HasSubstr("s.toml:2: mesh.file: found no file"));
  EXPECT_THAT(f.err, ::testing::HasSubstr("--set mesh.file=PATH"));
}

TEST_F(CliSceneFile, AShippedSceneFlies) {
  const Table t = read_table(results_of("flag-225 --steps 20 --level reference", "r") / "steps.csv");
  for (double strain : t.numbers("max_strain")) EXPECT_LT(strain, 0.5);
  EXPECT_GT(t.numbers("kinetic").back(), t.numbers("kinetic").front());
}

} // namespace
} // namespace hopmesh::tests
