// hopmesh network: the files' form, and that they say what the mathematics says.
#include "tests/cli/networks/network_by_hand.h"
#include "tests/support/cli_test.h"

#include <algorithm>
#include <regex>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

// Rests far below the tolerances that the tests ask for.
const std::string to_rest = " --set relax.threshold=1e-13 --set relax.max_sweeps=200000";

struct Files {
  Market W, bias, V0, V;
  Array predicted;

  std::vector<double> column(const Market& m) const {
    std::vector<double> values;
    for (const auto& row : m.values) values.push_back(row[0]);
    return values;
  }
};

class CliNetwork : public Cli {
 protected:
  Files files_of(const std::string& line, const std::string& out = "n") const {
    good("network " + line + " --out " + out);
    EXPECT_EQ(names_in(at(out)),
              (std::vector<std::string>{"V.mtx", "V0.mtx", "W.mtx", "bias.mtx", "predicted.npy"}));
    return {read_market(at(out + "/W.mtx")), read_market(at(out + "/bias.mtx")),
            read_market(at(out + "/V0.mtx")), read_market(at(out + "/V.mtx")),
            read_array(at(out + "/predicted.npy"))};
  }

  /// 3 x 3 nodes, left column pinned, structural and shear springs: a corner of a flag.
  static HandMesh nine_nodes() {
    HandMesh mesh{9, std::vector<bool>(9), {}};
    for (std::size_t r = 0; r < 3; ++r) mesh.pinned[3 * r] = true;
    for (std::size_t a = 0; a < 9; ++a)
      for (std::size_t b = a + 1; b < 9; ++b) {
        const auto down = static_cast<int>(b / 3) - static_cast<int>(a / 3);
        const auto right = static_cast<int>(b % 3) - static_cast<int>(a % 3);
        if (down <= 1 && std::abs(right) <= 1)
          mesh.springs.push_back({a, b, 1, std::sqrt(double(down * down + right * right))});
      }
    return mesh;
  }

  static void expect_by_hand(const Files& f, const HandMesh& mesh) {
    const HandNetwork hand = network_by_hand(mesh, 0.05, 1.0, f.predicted.values, f.column(f.V0));
    double largest_weight = 0, largest_bias = 0;
    for (const auto& row : hand.W)
      for (double w : row) largest_weight = std::max(largest_weight, std::fabs(w));
    for (double b : hand.bias) largest_bias = std::max(largest_bias, std::fabs(b));
    for (std::size_t r = 0; r < hand.bias.size(); ++r) {
      EXPECT_NEAR(f.bias.values[r][0], hand.bias[r], 1e-12 * largest_bias) << r;
      for (std::size_t c = 0; c < hand.bias.size(); ++c)
        EXPECT_NEAR(f.W.values[r][c], hand.W[r][c], 1e-12 * largest_weight) << r << ' ' << c;
    }
  }

  /// math: s = 0, or V at a bound with s pushing outward; counted in what a neuron's step would move.
  static double largest_kkt_violation(const Files& f) {
    double largest = 0;
    for (std::size_t r = 0; r < f.W.rows; ++r) {
      double s = f.bias.values[r][0], norm = std::fabs(s);
      for (std::size_t c = 0; c < f.W.columns; ++c) {
        s += f.W.values[r][c] * f.V.values[c][0];
        norm += std::fabs(f.W.values[r][c]);
      }
      if (norm == 0) continue;
      const double V = f.V.values[r][0], room = s >= 0 ? 1 - V : 1 + V;
      largest = std::max(largest, std::fabs(s) / norm * room);
    }
    return largest;
  }
};

TEST_F(CliNetwork, HeadersAndShapes) {
  const Files f = files_of("two-nodes --step 3");
  EXPECT_EQ(f.W.header, "%%MatrixMarket matrix coordinate real general");
  for (const Market* m : {&f.bias, &f.V0, &f.V}) {
    EXPECT_EQ(m->header, "%%MatrixMarket matrix array real general");
    EXPECT_EQ(m->rows, 6u);
    EXPECT_EQ(m->columns, 1u);
  }
  EXPECT_EQ(f.W.rows, 6u);
  EXPECT_EQ(f.W.columns, 6u);
  EXPECT_EQ(f.predicted.dtype, "<f8");
  EXPECT_EQ(f.predicted.shape, (std::vector<std::size_t>{2, 3}));
}

TEST_F(CliNetwork, TwoNodesAtStepZeroByHand) {
  const Files f = files_of("two-nodes --step 0");
  const double h = 0.00125, length = std::sqrt(1 + h * h); // spring (1, 0, -h): V0 = (0, 0, -1)
  EXPECT_EQ(f.predicted.values, (std::vector<double>{0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(f.column(f.V0), (std::vector<double>{0, 0, 0, 0, 0, -1}));
  const double xx = 2 * h * h * (1 - (1 - 1 / (1 + h * h)) / length), yy = 2 * h * h * (1 - 1 / length);
  EXPECT_NEAR(f.W.values[3][3], -xx, 1e-20);
  EXPECT_NEAR(f.W.values[4][4], -yy, 1e-20);
  EXPECT_NEAR(f.W.values[3][4], 0, 1e-20);
  // Along z the probe's own term comes in: beta = 0.05^4, B = 2 beta m m'.
  EXPECT_NEAR(f.W.values[5][5], -(2 * h * h * (1 - (1 - h * h / (1 + h * h)) / length) + 2 * 6.25e-6), 1e-18);
  EXPECT_NEAR(f.bias.values[4][0], 0, 1e-20);
  expect_by_hand(f, {2, {true, false}, {{0, 1, 1, 1}}});
}

TEST_F(CliNetwork, TwoNodesLaterByHand) {
  const Files f = files_of("two-nodes --step 1");
  EXPECT_NEAR(f.predicted.values[5], -0.00025, 1e-11); // v = dt g after step 0, as good as no probe energy
  for (const char* step : {"7", "39"})
    expect_by_hand(files_of(std::string("two-nodes --step ") + step), {2, {true, false}, {{0, 1, 1, 1}}});
}

TEST_F(CliNetwork, NineNodesAgreeWithTheMathematics) {
  const std::string scene = "flag-225 --set mesh.grid.rows=3 --set mesh.grid.columns=3";
  for (const char* step : {"0", "5", "60"}) expect_by_hand(files_of(scene + " --step " + step), nine_nodes());
}

TEST_F(CliNetwork, WIsSymmetricAndPinnedRowsAreEmpty) {
  const Files f = files_of("flag-225 --set mesh.grid.rows=3 --set mesh.grid.columns=3 --step 20");
  double largest = 0;
  for (std::size_t r = 0; r < f.W.rows; ++r)
    for (std::size_t c = 0; c < f.W.columns; ++c) {
      EXPECT_EQ(f.W.values[r][c], f.W.values[c][r]) << r << ' ' << c;
      largest = std::max(largest, std::fabs(f.W.values[r][c]));
      if (r / 3 % 3 == 0) {
        EXPECT_EQ(f.W.values[r][c], 0) << "row of a pinned node";
      }
    }
  EXPECT_GT(largest, 0);
  for (std::size_t node : {0, 3, 6})
    for (std::size_t p = 0; p < 3; ++p)
      for (const Market* m : {&f.bias, &f.V0, &f.V}) EXPECT_EQ(m->values[3 * node + p][0], 0);
  // 6 cells, 11 links: 9 weights of each pair, both ways, and nothing for pinned nodes.
  EXPECT_EQ(f.W.entries, 9u * (6 + 2 * 11));
}

TEST_F(CliNetwork, VIsAtRest) {
  const Files rest = files_of("flag-225 --set mesh.grid.rows=3 --set mesh.grid.columns=3 --step 4" + to_rest);
  EXPECT_LT(largest_kkt_violation(rest), 1e-12);
  for (const auto& row : rest.V.values) EXPECT_LE(std::fabs(row[0]), 1);
  Files start = rest; // the measure sees a state that is not at rest
  start.V = rest.V0;
  EXPECT_GT(largest_kkt_violation(start), 1e-6);
}

TEST_F(CliNetwork, V0IsTheRestBeforeAtUnitLength) {
  const Files before = files_of("two-nodes --step 4", "a"), after = files_of("two-nodes --step 5", "b");
  double square = 0;
  for (std::size_t p = 3; p < 6; ++p) square += std::pow(before.V.values[p][0], 2);
  for (std::size_t p = 3; p < 6; ++p)
    EXPECT_NEAR(after.V0.values[p][0], before.V.values[p][0] / std::sqrt(square), 1e-15);
}

TEST_F(CliNetwork, PlanarScenesHaveRowsTwoAndTwo) {
  const Files f = files_of("two-nodes --step 3 --set mesh.planar=true");
  EXPECT_EQ(f.W.rows, 4u); // x and z of node 0, x and z of node 1
  EXPECT_EQ(f.V.rows, 4u);
  EXPECT_EQ(f.predicted.shape, (std::vector<std::size_t>{2, 3}));
  const Files space = files_of("two-nodes --step 3", "s"); // nothing moves along y here
  for (const auto& [in_plane, in_space] : {std::pair(2, 3), {3, 5}}) {
    EXPECT_DOUBLE_EQ(f.bias.values[in_plane][0], space.bias.values[in_space][0]);
    EXPECT_DOUBLE_EQ(f.W.values[in_plane][in_plane], space.W.values[in_space][in_space]);
    EXPECT_NEAR(f.V0.values[in_plane][0], space.V0.values[in_space][0], 1e-15);
  }
}

TEST_F(CliNetwork, SetAndArrayCount) {
  const Files a = files_of("two-nodes --step 2", "a"),
              b = files_of("two-nodes --step 2 --set probe.beta=2", "b");
  EXPECT_NE(a.W.values, b.W.values);
  good("network flag-225 --step 1 --set mesh.grid.rows=3 --set mesh.grid.columns=3 --array descent --set "
       "array.schedule=sequential --out c");
}

TEST_F(CliNetwork, TellsWhatItWrote) {
  EXPECT_THAT(good("network two-nodes --step 3 --out 'my network'").out,
              ::testing::MatchesRegex(
                  "two-nodes step 3: 9 weights, [0-9]+ sweeps, converged; written to my network\n"));
}

TEST_F(CliNetwork, ADivergedMotionIsExitOneAndNoFile) {
  const Finished f = hopmesh("network two-nodes --set force.gravity=[0,0,-1e6] --step 30 --out n");
  EXPECT_EQ(f.exit_code, 1);
  EXPECT_THAT(f.out, ::testing::HasSubstr("diverged in step"));
  EXPECT_TRUE(names_in(at("n")).empty());
}

// The figures of what is sure of a step: for an array, and none for a probe, whose networks are not definite.
TEST_F(CliNetwork, TellsHowSureItsAnswerIs) {
  const std::string small =
      "network banner --set mesh.grid.rows=5 --set mesh.grid.columns=5 --step 2 --out n ";
  const std::string out = good(small + "--array descent").out;
  std::smatch figures;
  ASSERT_TRUE(std::regex_search(out, figures,
                                std::regex("V is (\\S+) rms from the answer; one solve tells (\\S+)\\.\n")))
      << out;
  EXPECT_NEAR(std::stod(figures[2]) / std::stod(figures[1]), 1, 0.1);
  EXPECT_THAT(
      out, ::testing::ContainsRegex("On the array descent, stopped by the scene's rule: beforehand at most "
                                    "[0-9.e-]+ \\(link = state, input by input, proved\\)"));
  EXPECT_THAT(good(small).out, ::testing::HasSubstr("the link is coarser than the state"));
  EXPECT_THAT(good("network flag-225 --step 1 --out n").out,
              ::testing::Not(::testing::HasSubstr("one solve")));
}

} // namespace
} // namespace hopmesh::tests
