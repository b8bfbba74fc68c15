// hopmesh solve with matrices as other programs write them: each kind is read right, or refused in a line.
#include "tests/support/cli_test.h"

namespace hopmesh::tests {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ForeignMatrices : public Cli {
 protected:
  void write(const std::string& name, const std::string& banner, const std::string& rest) const {
    write_text(at(name), banner + " matrix coordinate " + rest);
  }
  double output(const std::string& folder, std::size_t neuron) const {
    return read_market(at(folder + "/V.mtx")).values.at(neuron).at(0);
  }
};

// E = V1 V2 from (1, 1/2): the first is asked first and goes to -1, the second to 1.
TEST_F(ForeignMatrices, ReadAlikeHoweverTheyAreWritten) {
  write_text(at("start.mtx"), "%%MatrixMarket matrix array real general\n2 1\n1\n0.5\n");
  write("plain.mtx", "%%MatrixMarket", "real symmetric\n2 2 1\n2 1 -1.0\n");
  write("one_percent.mtx", "%MatrixMarket", "real symmetric\n2 2 1\n2 1 -1.0\n");
  write("fortran.mtx", "%%MatrixMarket", "real symmetric\n2 2 1\n2 1 -1.0D+00\n");
  write("integer.mtx", "\xEF\xBB\xBF%%MatrixMarket", "integer symmetric\r2 2 1\r2 1 -1\r");
  for (const std::string name : {"plain", "one_percent", "fortran", "integer"}) {
    const Finished f = good("solve " + name + ".mtx --start start.mtx --out " + name);
    EXPECT_EQ(f.err, "") << name;
    EXPECT_EQ(content_of(at(name + "/V.mtx")), content_of(at("plain/V.mtx"))) << name;
  }
  EXPECT_NEAR(output("plain", 0), -1, 1e-3);
  EXPECT_NEAR(output("plain", 1), 1, 1e-3);
}

TEST_F(ForeignMatrices, MistakesAreToldWithTheirLine) {
  write("fraction.mtx", "%%MatrixMarket", "integer symmetric\n2 2 1\n2 1 -1.5\n");
  refused("solve fraction.mtx", "fraction.mtx:3: found \"-1.5\", expected an integer, as the banner says");
  write("twice.mtx", "%%MatrixMarket", "real symmetric\n2 2 2\n2 1 -1\n2 1 -1\n");
  refused("solve twice.mtx", "twice.mtx:4: found row 2, column 1 twice, first in line 3");
}

TEST_F(ForeignMatrices, SkewOnesAskForTheWord) {
  write("skew.mtx", "%%MatrixMarket", "real skew-symmetric\n2 2 1\n2 1 -1.0\n");
  refused("solve skew.mtx",
          "W(1,2) = 1 but W(2,1) = -1, which differ most, by 2, expected a symmetric matrix");
  const Finished f = hopmesh("solve skew.mtx --asymmetric");
  EXPECT_EQ(f.err, "");
  EXPECT_THAT(f.out, HasSubstr("2 neurons, 2 weights"));
}

TEST_F(ForeignMatrices, RoundOffIsAveragedOutAndTold) {
  const std::string real = "real general\n3 3 5\n1 1 -2\n2 2 -2\n3 3 -2\n2 1 ";
  write("exact.mtx", "%%MatrixMarket", real + "0.3\n1 2 0.3\n");
  write("nearly.mtx", "%%MatrixMarket", real + "0.30000000000000004\n1 2 0.29999999999999993\n");
  EXPECT_EQ(good("solve exact.mtx").err, "");
  EXPECT_THAT(good("solve nearly.mtx").err,
              AllOf(HasSubstr("hopmesh: note: "),
                    HasSubstr("nearly.mtx: W and its transpose differ by 1.1e-16 at most, "
                              "which is round-off: their mean is taken")));
  write("one_half.mtx", "%%MatrixMarket", real + "0.3\n3 1 1e-17\n");
  EXPECT_THAT(refused("solve one_half.mtx"), HasSubstr("W(2,1) = 0.3 but W(1,2) = 0"));
  write("tiny_half.mtx", "%%MatrixMarket", real + "1e-17\n3 1 -1e-17\n");
  EXPECT_THAT(good("solve tiny_half.mtx").err, HasSubstr("differ by 1e-17 at most"));
  write("far.mtx", "%%MatrixMarket", real + "0.3\n1 2 0.30000001\n");
  refused("solve far.mtx", "which differ most, by 1e-08");
}

// The reference knows that the third neuron wants up; the array has lost the weight that says so.
TEST_F(ForeignMatrices, WeightsThatVanishAreCounted) {
  write("lost.mtx", "%%MatrixMarket", "real symmetric\n3 3 2\n2 1 -1\n3 2 -1e-5\n");
  write_text(at("start.mtx"), "%%MatrixMarket matrix array real general\n3 1\n1\n1\n-1\n");
  const Finished engine = good("solve lost.mtx --start start.mtx --out engine");
  EXPECT_THAT(engine.out, HasSubstr("2 weights and biases are too small for the format and became 0"));
  EXPECT_EQ(read_json(at("engine/summary.json"))["vanished"], 2);
  EXPECT_NEAR(output("engine", 2), -1, 1e-3);
  const Finished reference = good("solve lost.mtx --start start.mtx --level reference --out reference");
  EXPECT_THAT(reference.out, Not(HasSubstr("became 0")));
  EXPECT_NEAR(output("reference", 2), 1, 1e-9);
  const Finished wide = hopmesh("solve lost.mtx --set 'formats.weight=fixed<24,1,SC_RND,SC_SAT>'");
  EXPECT_EQ(wide.exit_code, 0);
  EXPECT_THAT(wide.out, Not(HasSubstr("became 0")));
}

TEST_F(ForeignMatrices, AnEnergyOfNothingHasNoSign) {
  write("W.mtx", "%%MatrixMarket", "real symmetric\n2 2 1\n2 1 -1\n");
  EXPECT_THAT(good("solve W.mtx").out, HasSubstr("Energy 0, at the start 0;"));
}

} // namespace
} // namespace hopmesh::tests
