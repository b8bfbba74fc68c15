// The array's row of hopmesh solvers, held to a run of the engine that `vectors` writes down phase by phase
// and to energies computed here from the network that `network` writes.
#include "tests/support/cli_test.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace hopmesh::tests {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int all_sweeps = 400, side = 6, outputs = 3 * side * (side - 1);
// Step 0 of so short a time step starts from zero at every level: its first scale fits.
const std::string small_banner = fmt::format(
    "banner --set mesh.grid.rows={0} --set mesh.grid.columns={0} --set motion.time_step=0.004 ", side);

/// Of a 6 x 6 grid whose first column is pinned: where an output of the array stands among all nodes'.
int place(int output) {
  const int free_node = output / 3;
  return 3 * (free_node / (side - 1) * side + 1 + free_node % (side - 1)) + output % 3;
}

class CliSolversArray : public Cli {
 protected:
  void SetUp() override {
    good("network " + small_banner + "--step 0 --out n");
    const Market weights = read_market(at("n/W.mtx")), biases = read_market(at("n/bias.mtx"));
    W.resize(outputs, outputs), I.resize(outputs);
    for (int i = 0; i < outputs; ++i) {
      I[i] = biases.values[place(i)][0];
      for (int j = 0; j < outputs; ++j) W(i, j) = weights.values[place(i)][place(j)];
    }
    answer = (-W).ldlt().solve(I);
    ASSERT_LT(answer.lpNorm<Eigen::Infinity>(), 1) << "no bound is active";
  }

  double energy(const VectorXd& V) const { return -V.dot(W * V) / 2 - I.dot(V); }
  double gap(const VectorXd& V) const {
    return (energy(V) - energy(answer)) / (energy(VectorXd::Zero(outputs)) - energy(answer));
  }

  /// After each sweep of the engine, from its raw outputs.
  std::vector<double> gaps_of_the_engine() const {
    good(fmt::format("vectors {} --set relax.threshold=0 --step 0 --sweeps {} --out v.txt", small_banner,
                     all_sweeps));
    std::vector<std::vector<int>> phases;
    VectorXd V = VectorXd::Zero(outputs);
    std::vector<double> gaps;
    for (const std::string& line : lines_of(content_of(at("v.txt")))) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "neuron") expect_start_at_zero(words);
      if (kind == "phase") phases.push_back(numbers_after(words, 1));
      if (kind != "fire") continue;
      std::size_t phase = 0;
      const auto codes = numbers_after(words, 3, &phase);
      for (std::size_t k = 0; k < codes.size(); ++k) V[phases[phase][k]] = codes[k] * std::ldexp(1.0, -22);
      if (phase + 1 == phases.size()) gaps.push_back(gap(V));
    }
    return gaps;
  }

  static void expect_start_at_zero(std::istringstream& words) {
    int neuron = 0, start = 1;
    words >> neuron >> start;
    EXPECT_EQ(start, 0) << neuron;
  }

  /// The rest of a line behind so many numbers; `second`: the second of those.
  static std::vector<int> numbers_after(std::istringstream& words, int skipped,
                                        std::size_t* second = nullptr) {
    std::vector<int> numbers;
    for (int n, k = 0; words >> n; ++k) {
      if (k == 1 && second) *second = static_cast<std::size_t>(n);
      if (k >= skipped) numbers.push_back(n);
    }
    return numbers;
  }

  /// The row that says what the array did.
  std::map<std::string, std::string> row(const std::string& more) const {
    good("solvers " + small_banner + "--step 0 " + more + " --out s");
    const Table t = read_table(at("s/solvers.csv"));
    EXPECT_EQ(t.column.at("method").at(0), "array");
    std::map<std::string, std::string> cells;
    for (const std::string& name : t.header) cells[name] = t.column.at(name).at(0);
    return cells;
  }

  MatrixXd W;
  VectorXd I, answer;
};

/// When a gap was first met; "" where it was not.
std::string first_within(const std::vector<double>& gaps, double wanted) {
  const auto found = std::find_if(gaps.begin(), gaps.end(), [&](double gap) { return gap <= wanted; });
  return found == gaps.end() ? "" : std::to_string(found - gaps.begin() + 1);
}

TEST_F(CliSolversArray, IsARunOfTheEngine) {
  const auto gaps = gaps_of_the_engine();
  ASSERT_EQ(gaps.size(), static_cast<std::size_t>(all_sweeps));
  auto cells = row(fmt::format("--gap 1e-1,1e-3,1e-5 --max-sweeps {}", all_sweeps));
  for (const auto& [name, wanted] :
       {std::pair{"sweeps@0.1", 1e-1}, {"sweeps@0.001", 1e-3}, {"sweeps@1e-05", 1e-5}})
    EXPECT_EQ(cells[name], first_within(gaps, wanted)) << name;
  const auto least = std::min_element(gaps.begin(), gaps.end());
  EXPECT_NEAR(std::stod(cells["least_gap"]) / *least, 1, 1e-6);
  EXPECT_EQ(cells["least_sweep"], std::to_string(least - gaps.begin() + 1));
}

// Quantised steps go down as long as they are many last places long.
TEST_F(CliSolversArray, FallsUntilItStalls) {
  const auto gaps = gaps_of_the_engine();
  const double least = *std::min_element(gaps.begin(), gaps.end());
  EXPECT_LT(least, 1e-5);
  for (std::size_t k = 1; k < gaps.size() && gaps[k - 1] > 30 * least; ++k)
    EXPECT_LT(gaps[k], gaps[k - 1]) << k;
}

TEST_F(CliSolversArray, FewerBitsStallHigher) {
  const auto least = [this](const std::string& format) {
    return std::stod(row("--set formats.state=" + format + " --set formats.link=" + format)["least_gap"]);
  };
  const double ten = least("fixed<10,2,SC_TRN_ZERO,SC_SAT>"),
               twenty = least("fixed<20,2,SC_TRN_ZERO,SC_SAT>");
  EXPECT_GT(ten, 30 * twenty);
  const std::string out = good("solvers " + small_banner + "--step 0").out;
  EXPECT_THAT(out, ::testing::ContainsRegex("array: lowest after [0-9]+ of [0-9]+ sweeps, at a gap of "));
  EXPECT_THAT(out, ::testing::HasSubstr("last places of 2.4e-07 at most"));
  EXPECT_THAT(out, ::testing::HasSubstr("that of the weights as loaded one of "));
}

/// Every stage, plain and corrected: seconds are cycles of array and bus at its clock, corrections come to
/// gaps that no words hold, and what one solve tells is what is measured.
TEST_F(CliSolversArray, ShowsEveryStageAndWhatIsSureOfIt) {
  const std::string out = good("solvers " + small_banner + "--step 0 --gap 1e-3,1e-12 --out s").out;
  const Table t = read_table(at("s/solvers.csv"));
  const auto& method = t.column.at("method");
  const auto cell = [&](const std::string& name, const std::string& column) {
    const auto row = std::find(method.begin(), method.end(), name) - method.begin();
    return t.column.at(column).at(static_cast<std::size_t>(row));
  };
  for (const std::string name : {"array", "array_projected", "array_momentum"}) {
    const double swept = std::stod(cell(name, "sweeps@0.001")),
                 cycles = std::stod(cell(name, "array_cycles@0.001"));
    EXPECT_GT(cycles, 20 * swept) << name;
    EXPECT_GT(std::stod(cell(name, "hardware_seconds@0.001")), 1e-8 * cycles) << "the bus comes on top";
    EXPECT_GT(std::stod(cell(name, "multiplies@0.001")), 6.0 * outputs * swept);
    const double measured = std::stod(cell(name, "output_error")), told = std::stod(cell(name, "told_error"));
    EXPECT_NEAR(told / measured, 1, 0.1) << name;
    EXPECT_EQ(cell(name, "held"), "0");
    if (!cell(name, "error_bound").empty()) {
      EXPECT_GE(std::stod(cell(name, "error_bound")), measured);
    }
    EXPECT_EQ(cell(name, "hardware_seconds@1e-12"), "") << "beyond its words";
  }
  EXPECT_NE(cell("array_momentum_corrected", "sweeps@1e-12"), "");
  EXPECT_LT(std::stod(cell("array_momentum", "array_cycles@0.001")),
            std::stod(cell("array", "array_cycles@0.001")) / 10);
  EXPECT_EQ(cell("cholesky", "hardware_seconds@0.001"), "");
  EXPECT_THAT(out, ::testing::HasSubstr("array_momentum: at rest by the scene's rule"));
  EXPECT_THAT(out, ::testing::HasSubstr("; one solve tells "));
  for (const char* picture : {"s/solvers.svg", "s/seconds.svg", "s/multiplies.svg"})
    EXPECT_THAT(content_of(at(picture)), ::testing::HasSubstr("array_momentum_corrected")) << picture;
}

TEST_F(CliSolversArray, AsksAFewWhereTold) {
  good("solvers " + small_banner + "--step 0 --only array_momentum,cholesky --out s");
  EXPECT_EQ(read_table(at("s/solvers.csv")).column.at("method"),
            (std::vector<std::string>{"array_momentum", "array_momentum_corrected", "cholesky"}));
  refused("solvers " + small_banner + "--step 0 --only newton",
          "--only: found newton, expected array, array_corrected");
}

} // namespace
} // namespace hopmesh::tests
