// The table of levels: rows that can be told apart and made, lookups that refuse, and a row of a test's own.
#include "sim/levels/level.h"
#include "sim/rivals/integrator.h"
#include "tests/support/complaint.h"
#include "tests/support/small_scenes.h"
#include "tests/support/soft_array.h"

#include <gmock/gmock.h>
#include <set>

namespace hopmesh::tests {
namespace {

using levels::Kind;
using levels::Level;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(LevelTable, EveryRowHasANameOfItsOwnAndOneWayToBeMade) {
  std::set<std::string> names;
  for (const Level& level : levels::levels()) {
    EXPECT_TRUE(names.insert(level.name).second) << level.name;
    EXPECT_NE(level.words, "") << level.name;
    EXPECT_NE(level.make_port == nullptr, level.make_mover == nullptr) << level.name;
    EXPECT_EQ(level.has_bus(), level.kind == Kind::array) << level.name;
    EXPECT_TRUE(level.has_bus() || !level.can_wave) << level.name;
    EXPECT_FALSE(level.variants.empty()) << level.name;
  }
}

TEST(LevelTable, ListsByKind) {
  EXPECT_THAT(levels::level_names({Kind::reference}), ElementsAre("reference"));
  EXPECT_THAT(levels::level_names({Kind::array}), ElementsAre("engine", "systemc", "systemc-clock", "rtl"));
  EXPECT_EQ(levels::level_names({Kind::rival}), rivals::names());
  EXPECT_EQ(levels::level_names().size(), levels::levels().size());
  EXPECT_THAT(levels::compared_names(), ElementsAre("reference", "engine", "systemc"));
  EXPECT_THAT(levels::campaign_names(), ElementsAre("engine", "systemc", "systemc-clock"));
  EXPECT_EQ(levels::default_level().name, "engine");
}

std::string refusal(const std::string& name, levels::Kinds kinds) {
  return complaint([&] { levels::level_named(name, "--level", kinds); });
}

TEST(LevelTable, RefusesANameOfNoneOrOfAnotherKind) {
  EXPECT_EQ(refusal("systemc", levels::any_kind), "");
  EXPECT_EQ(refusal("rk4", levels::any_kind), "");
  EXPECT_EQ(refusal("rk4", levels::sweeping),
            "--level: found rk4, expected reference, engine, systemc, systemc-clock, rtl");
  EXPECT_THAT(refusal("sytemc", levels::any_kind), HasSubstr("(did you mean systemc?)"));
  EXPECT_THAT(refusal("", levels::any_kind), HasSubstr("--level: expected reference, engine"));
}

TEST(LevelTable, TheFirstWayTakesPartInEveryCase) {
  const Level* slow = &levels::level_named("systemc-clock", "");
  const Level* engine = &levels::default_level();
  EXPECT_EQ(levels::ways_of({slow}).front().one_in, 1u);
  const auto ways = levels::ways_of({engine, slow});
  EXPECT_EQ(ways.front().name, "engine (generic)");
  EXPECT_EQ(ways.back().name, "systemc-clock");
  EXPECT_GT(ways.back().one_in, 1u);
  EXPECT_TRUE(ways.back().made_ahead);
}

TEST(LevelTable, AWayThatCannotHaveAnArrayMakesNone) {
  Level level{"odd"};
  level.make_port = [](const auto&, const auto&, const auto&) -> std::unique_ptr<levels::ArrayPort> {
    throw std::invalid_argument("only even ones");
  };
  EXPECT_EQ(levels::ways_of({&level})[0].make({}, {}), nullptr);
}

// What docs/extend.md promises: a port and a row make a level.
TEST(LevelTable, ALevelOfOnesOwnIsARow) {
  Level level{"soft", Kind::array, "the slow array of the tests"};
  level.make_port = [](const auto& array, const auto& topology, const levels::PortRequest&) {
    return std::make_unique<SoftArray>(array, topology);
  };
  const scene::Scene scene = grid_scene(2, 3);
  const levels::Prepared p{{scene, {}}, std::make_unique<levels::BuiltMesh>(scene)};
  const levels::ReadyLevel soft = levels::make_ready(level, p, true);
  const levels::ReadyLevel engine = levels::make_ready(levels::default_level(), p, true);
  EXPECT_EQ(soft.mover.get(), soft.array);
  for (int step = 0; step < 3; ++step) {
    const levels::StepRow a = soft.mover->advance(), b = engine.mover->advance();
    EXPECT_EQ(a.hash, b.hash) << step;
    EXPECT_EQ(a.cycles, b.cycles) << step;
    EXPECT_EQ(a.bus_cycles, b.bus_cycles) << step;
    EXPECT_EQ(a.error->rms_output, b.error->rms_output) << step;
  }
}

} // namespace
} // namespace hopmesh::tests
