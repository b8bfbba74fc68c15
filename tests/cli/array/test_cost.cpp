// hopmesh cost: by the model at once, and by tools where they are; here tools that say what they are told.
#include "tests/support/cli_test.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace hopmesh::tests {
namespace {

namespace fs = std::filesystem;

class CliCost : public Cli {};

TEST_F(CliCost, ByTheModelAtOnce) {
  const std::string out = good("cost flag-400 --array folded --model").out;
  EXPECT_NE(out.find("LUT4"), std::string::npos);
  EXPECT_NE(out.find("kGE, model"), std::string::npos) << out;
  EXPECT_EQ(out.find("measured"), std::string::npos);
}

TEST_F(CliCost, AsJson) {
  const auto json = nlohmann::json::parse(good("cost banner --array folded --model --json --sweeps 78").out);
  EXPECT_EQ(json.at("array"), "folded");
  ASSERT_FALSE(json.at("figures").empty());
  for (const auto& figure : json.at("figures"))
    EXPECT_TRUE(figure.at("origin") == "model" || figure.at("origin") == "measured") << figure;
  good("cost banner --array folded --model --sweeps 78 --out cost");
  EXPECT_EQ(nlohmann::json::parse(content_of(at("cost") / "cost.json")), json);
}

TEST_F(CliCost, MoreSweepsTakeMoreEnergy) {
  const auto energy = [&](const std::string& sweeps) {
    const auto json =
        nlohmann::json::parse(good("cost banner --array folded --model --json --sweeps " + sweeps).out);
    for (const auto& f : json.at("figures"))
      if (f.at("name").get<std::string>().rfind("energy by the published table", 0) == 0)
        return f.at("value").get<double>();
    return 0.0;
  };
  EXPECT_GT(energy("10"), 0);
  EXPECT_GT(energy("20"), energy("10"));
}

TEST_F(CliCost, WithoutToolsTheModelStandsIn) {
  around.environment = {{"PATH", "/nowhere"}};
  const Finished f = good("cost two-nodes --array folded --no-place");
  EXPECT_THAT(f.err, testing::HasSubstr("not installed: yosys, nextpnr-ice40, opensta"));
  EXPECT_EQ(f.out.find("measured"), std::string::npos);
}

TEST_F(CliCost, AnArrayThatRtlDoesNotCoverIsToldOfTheModel) {
  const Finished f = good("cost two-nodes --no-place");
  EXPECT_THAT(f.err, testing::HasSubstr("no RTL of this array"));
  EXPECT_EQ(f.out.find("measured"), std::string::npos);
}

// A yosys that answers as the real one does: 10 LUT4 an element, 200 the stage, 3000 the rest; it dies of the
// stage's multipliers on iCE40.
class CliCostTools : public CliCost {
 protected:
  CliCostTools() {
    fs::create_directory(at("tools"));
    std::ofstream(at("tools") / "yosys") << R"(#!/bin/sh
script=$3
grep -q 'synth_ice40 -dsp' "$script" && case $script in *stage*) exit 1 ;; esac
case $script in
  *element*) luts=10 ;;
  *stage*) luts=200 ;;
  *) luts=3000 ;;
esac
[ "$script" = cost/parts.ys ] && printf '\n2 modules:\n  hm_element\n  $paramod$12\\hm_stage\n  hopmesh_axi_top\n' > cost/modules.txt
stat=$(sed -n 's/^tee -q -o \(cost.*stat\) stat.*/\1/p' "$script")
[ -z "$stat" ] || printf '   Number of cells:   9\n     LUT4    %s\n     SB_LUT4    %s\n     TRELLIS_FF   7\n\n' $luts $luts > "$stat"
)";
    fs::permissions(at("tools") / "yosys", fs::perms::owner_all);
    around.environment = {{"PATH", at("tools").string() + ":/usr/bin:/bin"}};
  }
};

TEST_F(CliCostTools, PartsAreMeasuredAndCounted) {
  const Finished f = hopmesh("cost two-nodes --array folded --no-place --json --out kept -j 1");
  ASSERT_EQ(f.exit_code, 0) << f.err;
  const auto json = nlohmann::json::parse(f.out);
  const auto figure = [&](const std::string& name) {
    for (const auto& row : json.at("figures"))
      if (row.at("name") == name) return row;
    return nlohmann::json();
  };
  EXPECT_EQ(figure("LUT4").at("value"), 16 * 10 + 200 + 3000);
  EXPECT_EQ(figure("LUT4").at("origin"), "measured");
  EXPECT_EQ(figure("flip-flops").at("value"), 18 * 7);
  EXPECT_THAT(f.err, testing::HasSubstr("yosys died of synth_ice40 -dsp"));
  EXPECT_TRUE(fs::exists(at("kept") / "cost.json"));
  EXPECT_TRUE(fs::exists(at("kept") / "design" / "hopmesh_top.v"));
}

TEST_F(CliCostTools, APointIsARowOfTheTable) {
  const Finished f = hopmesh("cost two-nodes --array folded --no-place --point");
  ASSERT_EQ(f.exit_code, 0) << f.err;
  const std::vector<std::string> lines = lines_of(f.out);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].rfind("array,use,BIAS_BITS,", 0), 0u);
  EXPECT_EQ(lines[1].rfind("folded,held,24,", 0), 0u);
}

} // namespace
} // namespace hopmesh::tests
