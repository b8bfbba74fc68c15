// What stands in the files of a run: shapes, columns, ranges, totals, and that a manifest repeats its run.
#include "tests/support/cli_test.h"

#include "place.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Six nodes in a row, 0 and 3 pinned. A sheet would cost each run most of a second for its picture.
const std::string six_nodes =
    "two-nodes --set mesh.grid.columns=6 --set mesh.pinned=[0,3] --set force.wind=[0.3,0.1,0]";

class CliResults : public Cli {
 protected:
  /// Scene and array of a manifest as files, run again.
  fs::path repeated(const fs::path& results) const {
    const auto manifest = read_json(results / "manifest.json");
    write_text(at("again-scene.toml"), manifest["scene"]);
    write_text(at("again-array.toml"), manifest["array"]);
    return results_of(
        "again-scene.toml --array again-array.toml --level " + manifest["level"].get<std::string>(), "again");
  }
};

TEST_F(CliResults, StepsCsvBeginsWithTheColumnsThatToolsRelyOn) {
  const Table t = read_table(results_of("two-nodes --steps 5", "r") / "steps.csv");
  const std::vector<std::string> fixed{"step",    "time",       "sweeps",    "cycles",   "energy",
                                       "kinetic", "max_strain", "saturated", "converged"};
  ASSERT_GE(t.header.size(), fixed.size());
  EXPECT_TRUE(std::equal(fixed.begin(), fixed.end(), t.header.begin()));
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(t.numbers("step")[k], static_cast<double>(k));
    EXPECT_DOUBLE_EQ(t.numbers("time")[k], 0.05 * static_cast<double>(k + 1));
    EXPECT_EQ(t.numbers("converged")[k], 1);
  }
}

TEST_F(CliResults, CyclesFollowTheFormulaOfTheCyclesPage) {
  const Table t = read_table(results_of("two-nodes", "r") / "steps.csv");
  // Rows of 3 taps, one lane, reciprocal of 18 bits: prepare 3 + 18 + 1; sweep 3 (3 + 2 + 2) + 1.
  for (std::size_t k = 0; k < t.rows(); ++k)
    EXPECT_EQ(t.numbers("cycles")[k], 1 + 22 + 22 * t.numbers("sweeps")[k]);
}

TEST_F(CliResults, FirstPositionsAreTheMeshAndPinnedNodesStay) {
  const Array p = read_array(results_of(six_nodes + " --steps 4", "r") / "positions.npy");
  ASSERT_EQ(p.shape, (std::vector<std::size_t>{5, 6, 3}));
  for (std::size_t node = 0; node < 6; ++node) {
    EXPECT_EQ(p.values[3 * node], static_cast<double>(node));
    EXPECT_EQ(p.values[3 * node + 1], 0);
    EXPECT_EQ(p.values[3 * node + 2], 0);
  }
  for (std::size_t step = 0; step < 5; ++step)
    for (std::size_t node : {0, 3})
      for (std::size_t x = 0; x < 3; ++x)
        EXPECT_EQ(p.values[(step * 6 + node) * 3 + x], p.values[node * 3 + x]);
}

TEST_F(CliResults, RawOutputsStayWithinOneAndPinnedNodesHaveNone) {
  for (const auto& [array, one] : {std::pair("guarded", 1 << 22), {"descent", 1 << 14}, {"byte", 1 << 6}}) {
    const Array v =
        read_array(results_of(six_nodes + " --steps 6 --array " + array, array) / "outputs_raw.npy");
    ASSERT_EQ(v.shape, (std::vector<std::size_t>{6, 6, 3}));
    double largest = 0;
    for (std::size_t k = 0; k < v.values.size(); ++k) {
      largest = std::max(largest, std::fabs(v.values[k]));
      if (k / 3 % 3 == 0) {
        EXPECT_EQ(v.values[k], 0) << "of a pinned node";
      }
    }
    EXPECT_LE(largest, one) << array;
    EXPECT_GT(largest, one / 2) << array; // a probe is a direction: near unit length
  }
}

TEST_F(CliResults, PlanarScenesHaveTwoOutputsANodeAndNeverLeaveTheirPlane) {
  for (const char* level : {"systemc", "systemc-clock"}) {
    const fs::path r = results_of(
        six_nodes + " --steps 4 --set mesh.planar=true --set force.wind=[0.3,0,0] --level " + level, level);
    EXPECT_EQ(read_array(r / "outputs_raw.npy").shape, (std::vector<std::size_t>{4, 6, 2}));
    const Array p = read_array(r / "positions.npy");
    for (std::size_t k = 1; k < p.values.size(); k += 3) EXPECT_EQ(p.values[k], 0);
  }
  expect_same_bits(at("systemc"), at("systemc-clock"));
}

TEST_F(CliResults, EnergiesAndStrainsOfTheTableFollowFromThePositions) {
  const fs::path r = results_of("two-nodes --steps 9", "r");
  const Array p = read_array(r / "positions.npy");
  const Table t = read_table(r / "steps.csv");
  for (std::size_t k = 0; k < 9; ++k) {
    const double* x = &p.values[6 * (k + 1)];
    const double length = std::sqrt(x[3] * x[3] + x[4] * x[4] + x[5] * x[5]);
    EXPECT_NEAR(t.numbers("energy")[k], (length - 1) * (length - 1), 1e-15);
    EXPECT_NEAR(t.numbers("max_strain")[k], std::fabs(length - 1), 1e-15);
    EXPECT_NEAR(t.numbers("max_stretch")[k], length, 1e-15);
  }
}

TEST_F(CliResults, StatsAreTheSumsOfTheTable) {
  const fs::path r = results_of(six_nodes + " --steps 6", "r");
  const auto stats = read_json(r / "stats.json");
  const Table t = read_table(r / "steps.csv");
  const auto sum = [&](const char* name) {
    const auto values = t.numbers(name);
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  EXPECT_EQ(stats["sweeps"], sum("sweeps"));
  EXPECT_EQ(stats["array_cycles"], sum("cycles"));
  EXPECT_EQ(stats["bus_cycles"], sum("bus_cycles"));
  EXPECT_EQ(stats["neuron_updates"], sum("sweeps") * 12);
  EXPECT_EQ(stats["steps_stopped_by_max_sweeps"], 6 - sum("converged"));
  EXPECT_EQ(stats["nodes"], 6);
  EXPECT_EQ(stats["neurons"], 12);
  for (const auto& range : stats["ranges"]) EXPECT_LE(range["least_raw"], range["largest_raw"]);
  EXPECT_EQ(stats["ranges"].size(), 5u); // weight, bias, state, accumulator, drive
}

TEST_F(CliResults, StateRangeIsThatOfTheRawOutputs) {
  const fs::path r = results_of("two-nodes", "r");
  const auto v = read_array(r / "outputs_raw.npy").values;
  const auto ranges = read_json(r / "stats.json")["ranges"];
  const auto state =
      std::find_if(ranges.begin(), ranges.end(), [](const auto& x) { return x["signal"] == "state"; });
  EXPECT_LE((*state)["least_raw"], *std::min_element(v.begin(), v.end()));
  EXPECT_GE((*state)["largest_raw"], *std::max_element(v.begin(), v.end()));
}

TEST_F(CliResults, AManifestRepeatsItsRunBitForBit) {
  const fs::path r =
      results_of(six_nodes + " --steps 5 --array byte --set array.lanes=2 --set probe.gamma=1e3", "r");
  expect_same_bits(r, repeated(r));
  EXPECT_EQ(read_json(r / "manifest.json")["scene"], read_json(at("again") / "manifest.json")["scene"]);
}

TEST_F(CliResults, AManifestRepeatsAMeshFileFromAnywhere) {
  fs::create_directories(at("scenes"));
  fs::copy(HOPMESH_SOURCE_DIR "/tests/scene/good/tent.obj", at("scenes/tent.obj"));
  write_text(at("scenes/tent.toml"), "[mesh]\nfile = \"tent.obj\"\npinned = [0]\n[motion]\nsteps = 3\n"
                                     "[force]\ngravity = [0.0, 0.0, -0.1]\n");
  const fs::path r = results_of("scenes/tent.toml", "r");
  expect_same_bits(r, repeated(r));
}

TEST_F(CliResults, AManifestKnowsWhetherItsFilesAreStillTheSame) {
  const std::string scenes = HOPMESH_SOURCE_DIR "/sim/scenes/";
  const auto hashes = [&](const std::string& obj, const std::string& pgm) {
    write_text(at("s.obj"), obj), write_text(at("s.pgm"), pgm);
    const auto m = read_json(results_of("snake --steps 1 --set mesh.file=" + at("s.obj").string() +
                                            " --set force.image.file=" + at("s.pgm").string(),
                                        "r") /
                             "manifest.json");
    return std::pair<std::string, std::string>(m["mesh_hash"], m["image_hash"]);
  };
  const std::string obj = content_of(scenes + "snake.obj"), pgm = content_of(scenes + "snake.pgm");
  const auto first = hashes(obj, pgm);
  EXPECT_EQ(hashes(obj + "# a word more\n", pgm), first) << "of the mesh as built";
  const auto moved = hashes(
      obj.substr(0, obj.find("v ")) + "v 59 0 -31.5" + obj.substr(obj.find('\n', obj.find("v "))), pgm);
  EXPECT_NE(moved.first, first.first);
  EXPECT_EQ(moved.second, first.second);
  std::string other = pgm;
  other.back() = static_cast<char>(other.back() ^ 1);
  EXPECT_EQ(hashes(obj, other).first, first.first);
  EXPECT_NE(hashes(obj, other).second, first.second);
  EXPECT_TRUE(read_json(results_of("two-nodes --steps 1", "r") / "manifest.json")["image_hash"].is_null());
}

TEST_F(CliResults, TheCommandOfAManifestRepeatsTheRun) {
  const fs::path r = results_of("two-nodes --steps 3 --set 'force.gravity=[0, 0, -0.2]' --array byte", "r");
  const std::string command = read_json(r / "manifest.json")["command"];
  ASSERT_EQ(command.rfind("hopmesh run ", 0), 0u);
  expect_same_bits(r, results_of(command.substr(12), "again"));
}

TEST_F(CliResults, TheSameRunTwiceGivesTheSameBits) {
  const fs::path a = results_of(six_nodes + " --steps 5", "a");
  expect_same_bits(a, results_of(six_nodes + " --steps 5", "b"));
  around.environment = {{"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE.UTF-8"}, {"OMP_NUM_THREADS", "7"}};
  around.folder = at("elsewhere");
  fs::create_directories(around.folder);
  expect_same_bits(a, results_of(six_nodes + " --steps 5", "c"));
  around.folder = a.parent_path();
}

TEST_F(CliResults, ALevelWithoutCodesLeavesNoneOfAnEarlierRun) {
  results_of("two-nodes --steps 2", "r");
  EXPECT_EQ(fault_of_results(results_of("two-nodes --steps 2 --level reference", "r"), 2, false), "");
}

} // namespace
} // namespace hopmesh::tests
