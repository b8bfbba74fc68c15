// Pages show the tables of the program as they are.
#include "firmware/registers.h"
#include "sim/scene/scene.h"
#include "tests/house/page_tables.h"
#include "tests/house/tree.h"

#include <gtest/gtest.h>
#include <regex>

namespace hopmesh::tests {
namespace {

TEST(PageTables, areAsTheProgramHasThem) {
  for (const char* path : {registers_page, scene_page, array_page, results_page, studies_page}) {
    const std::string page = text_of(path);
    EXPECT_NE(page.find("<!-- table "), std::string::npos) << path;
    EXPECT_EQ(page, with_tables(page)) << "stale: run build-check/print_tables " << path;
  }
}

// A line of the table is all that a page needs of a new column.
TEST(PageTables, showAColumnOfYourOwn) {
  const levels::StepColumn swing("swing", "V", "left |in| it", &levels::StepRow::alternation,
                                 levels::Subject::reference, {},
                                 levels::Total{levels::Summary::median, "median_swing"},
                                 levels::Total{levels::Summary::largest, "largest_swing"});
  EXPECT_EQ(step_table({swing}),
            "| column | meaning | unit | in `stats.json` |\n|---|---|---|---|\n"
            "| `swing` | left \\|in\\| it | V | median: `against_reference.median_swing`; largest: "
            "`against_reference.largest_swing` |\n");
  EXPECT_EQ(result_table({{"heat", "", "left behind", &study::PointRow::reference_at}}),
            "| column | meaning | unit |\n|---|---|---|\n| `heat@T` | left behind | |\n");
}

// A row is all that a page needs of a new key.
TEST(PageTables, showARowOfYourOwn) {
  static double spin = 0.5;
  const input::Keys keys{input::Key("mesh.spin", &spin, {0, 2000, ""}, "turns").in_unit("1/s")};
  const std::string table = key_table(keys);
  EXPECT_NE(table.find("| `mesh.spin` | turns | 1/s | `0.5` | 0 to 2,000 |\n"), std::string::npos) << table;
}

TEST(PageTables, showEveryKeyOfAScene) {
  scene::Scene scene;
  const std::string page = text_of(scene_page);
  for (const input::Key& key : scene_keys(scene))
    if (!std::holds_alternative<input::Part>(key.place)) {
      EXPECT_NE(page.find("| `" + key.name + "` | "), std::string::npos) << key.name;
    }
}

TEST(PageTables, showEveryRegisterWindowAndFieldOfAFewBits) {
  const std::string page = text_of(registers_page);
#define HM_X(name, ...) EXPECT_NE(page.find("| `" #name "` | 0x"), std::string::npos) << #name;
  HM_REGISTERS(HM_X)
#undef HM_X
#define HM_X(name, ...) EXPECT_NE(page.find("\n| `" #name "` | R"), std::string::npos) << #name;
  HM_WINDOWS(HM_X)
#undef HM_X
#define HM_X(reg, field, lowest, width, ...)                                                                 \
  EXPECT_EQ(std::regex_search(page, std::regex("\\| `" #reg "` \\| [0-9:]+ \\| `" #field "` \\|")),          \
            (width) < 32)                                                                                    \
      << #reg " " #field;
  HM_FIELDS(HM_X)
#undef HM_X
}

TEST(PageTables, replaceOldOnes) {
  const std::string page = "before\n<!-- table windows -->\n| old |\n<!-- end -->\nafter\n";
  const std::string printed = with_tables(page);
  EXPECT_EQ(printed.find("| old |"), std::string::npos);
  EXPECT_NE(printed.find("| `LINK` | RO |"), std::string::npos);
  EXPECT_EQ(printed.substr(printed.size() - 19), "<!-- end -->\nafter\n");
}

} // namespace
} // namespace hopmesh::tests
