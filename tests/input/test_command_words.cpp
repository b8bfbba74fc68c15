// What the program prints for a shell, a shell must take back.
#include "sim/input/command_words.h"

#include <gtest/gtest.h>

namespace hopmesh::tests {
namespace {

TEST(CommandWords, areQuotedWhereAShellWouldAsk) {
  EXPECT_EQ(input::shell_word("out/flag-400"), "out/flag-400");
  EXPECT_EQ(input::shell_word(""), "''");
  EXPECT_EQ(input::shell_word("two words"), "'two words'");
  EXPECT_EQ(input::shell_word("it's"), "'it'\\''s'");
}

TEST(CommandWords, nameTheInputsOfARun) {
  EXPECT_EQ(input::text_of({"banner", "", {}}), "banner");
  EXPECT_EQ(input::text_of({"my scene", "descent", {"array.lanes=3", "motion.force=[0, 1, 0]"}}),
            "'my scene' --array descent --set array.lanes=3 --set 'motion.force=[0, 1, 0]'");
}

TEST(CommandWords, takeOtherStepsThanTheScenes) {
  EXPECT_EQ(input::text_of(input::with_steps({"banner", "", {}}, 5)), "banner --set motion.steps=5");
  EXPECT_EQ(input::text_of(input::with_steps({"banner", "", {}}, 0)), "banner");
}

} // namespace
} // namespace hopmesh::tests
