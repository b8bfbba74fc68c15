// Habits of code that a reader can count on: short functions, comments that name their subject, and levels
// that are named at home only. First of all, that the reading of code is not blind.
#include "sim/levels/level.h"
#include "tests/house/source_code.h"
#include "tests/house/tree.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <set>

namespace hopmesh::tests {
namespace {

std::string place(const TreeFile& file, std::size_t line) {
  return file.path + ":" + std::to_string(line);
}

TEST(Code, isReadAsItIsMeant) {
  const Code code =
      code_of("// One. Two: it\n// is. The same\nint a = 1'000; // b \"c\"\n"
              "char d = '\"'; const char* e = \"f // \\\"g\"; // h\nauto i = R\"x(\"j)\")x\";\n");
  ASSERT_EQ(code.comments.size(), 3u);
  EXPECT_EQ(code.comments[0].text, "One. Two: it is. The same");
  EXPECT_EQ(sentences_of(code.comments[0].text), (std::vector<std::string>{"One", "Two: it is", "The same"}));
  EXPECT_EQ(code.comments[2].line, 4u);
  ASSERT_EQ(code.strings.size(), 2u);
  EXPECT_EQ(code.strings[0].text, "f // \\\"g");
  EXPECT_EQ(code.strings[1].line, 5u);
  EXPECT_EQ(lines_of(code.bare).size(), 5u);
}

TEST(Code, hasItsFunctionsFound) {
  const auto lengths = [](const std::string& text) {
    std::vector<std::size_t> lines;
    for (const Function& f : functions_of(code_of(text))) lines.push_back(f.lines);
    return lines;
  };
  using Lengths = std::vector<std::size_t>;
  EXPECT_EQ(lengths("namespace a {\nstruct B {\n  B() : c{1},\n        d(2) {}\n};\n} // namespace a\n"),
            Lengths{2});
  EXPECT_EQ(lengths("#define F(x) {\nint f(\n    int x) {\n  if (x) {\n  }\n  return x;\n}\n"), Lengths{6});
  EXPECT_EQ(lengths("const T t = {\n  {1, f(2)},\n};\nvoid g() {\n}\nint h() { return 1; }\n"),
            (Lengths{2, 1}));
}

TEST(Code, hasNoFunctionOverFiftyLines) {
  for (const TreeFile& file : tree_files({".h", ".c", ".cpp"}))
    for (const Function& f : functions_of(code_of(file.text)))
      EXPECT_LE(f.lines, 50u) << place(file, f.line) << " does more than one thing?";
}

// docs/decisions/0006-comments-name-their-subject.md
TEST(Code, hasNoCommentThatHidesItsSubject) {
  static const std::regex riddle(R"(^(The same|Both|One|It)\b.*)");
  for (const TreeFile& file : tree_files({".h", ".c", ".cpp", ".sv", ".js"}))
    for (const Piece& comment : code_of(file.text).comments)
      for (const std::string& sentence : sentences_of(comment.text))
        EXPECT_FALSE(std::regex_match(sentence, riddle)) << place(file, comment.line) << ": " << sentence;
}

// Files outside sim/levels in which the name of a level may stand as a string, and why.
const std::map<std::string, std::string> name_levels = {
    {"sim/rivals/", "each rival knows its own name"},
    {"sim/scene/", "implicit rules are keys of a scene; two rivals are called after them"},
    {"sim/reference/", "the implicit rules again"},
    {"sim/cli/array/rtl.cpp", "a verb bears such a name"},
    {"sim/study/result_chart.cpp", "the method beside which a chart draws a step solved exactly"},
};

/// The start of its path that lets a file name levels; "" where nothing does.
std::string leave_to_name_levels(const std::string& path) {
  if (!starts_with(path, "sim/") || starts_with(path, "sim/levels/")) return "at home";
  for (const auto& [start, reason] : name_levels)
    if (starts_with(path, start)) return start;
  return "";
}

TEST(Code, namesLevelsAtHomeOnly) {
  const std::vector<std::string> names = levels::level_names();
  std::set<std::string> made_use_of;
  for (const TreeFile& file : tree_files({".h", ".cpp"}))
    for (const Piece& string : code_of(file.text).strings)
      if (std::count(names.begin(), names.end(), string.text)) {
        const std::string leave = leave_to_name_levels(file.path);
        EXPECT_NE(leave, "") << place(file, string.line) << ": \"" << string.text << "\"";
        made_use_of.insert(leave);
      }
  for (const auto& [start, reason] : name_levels)
    EXPECT_EQ(made_use_of.count(start), 1u) << start << " names no level any more";
}

} // namespace
} // namespace hopmesh::tests
