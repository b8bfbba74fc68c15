// The shipped studies of folds: every point really runs, and comes to what the formulas say of it.
#include "rtl_model/spec/cycles.h"
#include "sim/levels/array_port.h"
#include "sim/levels/prepared.h"
#include "sim/machine/silicon.h"
#include "sim/machine/timeline.h"
#include "tests/support/cli_test.h"

namespace hopmesh::tests {
namespace {

class CliElements : public Cli {
 protected:
  /// The rows of a sweep of that study, whose points are of that scene.
  void expect_formulas(const std::string& study, const std::string& scene, std::size_t points) {
    good("sweep " + study + " --out " + study);
    const Table t = read_table(at(study) / "results.csv");
    ASSERT_EQ(t.column.at("point").size(), points);
    for (std::size_t k = 0; k < points && !HasFailure(); ++k) expect_point(t, k, scene);
  }

 private:
  void expect_point(const Table& t, std::size_t k, const std::string& scene) {
    const auto cell = [&](const char* name) { return t.column.at(name)[k]; };
    const auto count = [&](const char* name) { return std::stoull(cell(name)); };
    SCOPED_TRACE(cell("command"));
    std::vector<std::string> keys;
    for (const char* axis : {"array.elements", "array.packing"})
      keys.push_back(std::string(axis) + "=" + cell(axis));
    keys.push_back("array.stages=\"" + cell("array.stages") + "\"");
    const levels::Prepared p = levels::prepare(scene, "", keys);
    const spec::Topology& topology = p.mesh->topology();
    const spec::ArraySpec& array = p.inputs.array;
    const std::uint64_t steps = count("steps"), sweeps = count("sweeps");
    EXPECT_EQ(cell("sweeps"), t.column.at("sweeps")[0]) << "a fold changes no bit";
    EXPECT_EQ(cell("output_error"), t.column.at("output_error")[0]);
    const machine::Work work = machine::work_of(array, topology, steps, sweeps, levels::longest_burst);
    EXPECT_EQ(count("cycles"), work.array_cycles);
    EXPECT_EQ(count("bus_cycles"), work.bus_cycles + steps * 2 * spec::bus_cycles(array, 1));
    EXPECT_EQ(count("memory_bits"), machine::memory_bits(array, topology).total());
    EXPECT_EQ(count("multiplier_bits"), machine::multiplier_bits(array, topology).total());
    EXPECT_EQ(count("divider_bits"), machine::divider_bits(array, topology));
    const double products = double(sweeps) * double(topology.weight_words());
    EXPECT_NEAR(std::stod(cell("utilisation")), products / (array.elements * double(count("cycles"))), 1e-12);
    EXPECT_NEAR(std::stod(cell("utilisation_with_bus")),
                products / (array.elements * double(count("cycles") + count("bus_cycles"))), 1e-12);
  }
};

TEST_F(CliElements, OfTheFlagComeToWhatTheFormulasSay) {
  expect_formulas("flag-elements", "flag-400", 2 * 2 * 14);
}

TEST_F(CliElements, OfTheBannerComeToWhatTheFormulasSay) {
  expect_formulas("banner-elements", "banner", 2 * 2 * 14);
}

} // namespace
} // namespace hopmesh::tests
