// Every shipped scene runs, at reference and systemc.
#include "tests/support/cli_test.h"

#include "place.h"

#include <cmath>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const std::string& file : names_in(HOPMESH_SOURCE_DIR "/sim/scenes"))
    if (fs::path(file).extension() == ".toml") names.push_back(fs::path(file).stem());
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
    const fs::path r =
        results_of(GetParam() + " --steps 2 --set relax.max_sweeps=300 --no-check --level " + level, level);
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
  const std::string err = refused("run s.toml", "s.toml:2: mesh.file: found no file");
  EXPECT_THAT(err, ::testing::HasSubstr("--set mesh.file=PATH"));
}

TEST_F(CliSceneFile, AShippedSceneFlies) {
  const Table t = read_table(results_of("flag-225 --steps 20 --level reference", "r") / "steps.csv");
  for (double strain : t.numbers("max_strain")) EXPECT_LT(strain, 0.5);
  EXPECT_GT(t.numbers("kinetic").back(), t.numbers("kinetic").front());
}

/// Root mean square distance of the nodes after half a second.
double distance(const Array& a, const Array& b) {
  const std::size_t size = a.shape[1] * 3;
  double squares = 0;
  for (std::size_t k = 0; k < size; ++k) {
    const double d = a.values[a.values.size() - size + k] - b.values[b.values.size() - size + k];
    squares += d * d;
  }
  return std::sqrt(squares / static_cast<double>(a.shape[1]));
}

// What 16 bits on the links cost must vanish beside what the step's length costs: the array against the same
// step done exactly, and that against steps of a tenth and of second order.
TEST_F(CliSceneFile, SixteenBitsAddLessThanATenthToTheErrorOfTheBannersStep) {
  const std::string exactly = "banner --level reference --set relax.threshold=1e-9 --set relax.expansions=4 "
                              "--set relax.max_sweeps=3000";
  const auto positions = [&](const std::string& line, const std::string& name) {
    return read_array(results_of(line, name) / "positions.npy");
  };
  const Array array = positions("banner", "a"), exact = positions(exactly, "e");
  const Array truth = positions(exactly + " --set incremental.rule=bdf2 --set motion.time_step=0.002 "
                                          "--steps 250",
                                "t");
  const double step_error = distance(exact, truth), extra = distance(array, exact);
  EXPECT_GT(step_error, 1e-3);
  EXPECT_LT(extra, 0.1 * step_error) << step_error;
}

} // namespace
} // namespace hopmesh::tests
