// SystemRDL, read by a small reader of its own, and held against the one table.
#include "tests/describe/told_table.h"

#include <gtest/gtest.h>
#include <map>
#include <regex>

namespace hopmesh::tests {
namespace {

/// Words, numbers, marks and texts of a SystemRDL file; comments are left out.
std::vector<std::string> rdl_tokens(const std::string& text) {
  static const std::regex shape(R"(//[^\n]*|"(?:[^"\\]|\\.)*"|[A-Za-z_0-9]+|[^\s])");
  std::vector<std::string> tokens;
  for (std::sregex_iterator at(text.begin(), text.end(), shape), end; at != end; ++at)
    if (at->str().rfind("//", 0) != 0) tokens.push_back(at->str());
  return tokens;
}

/// Reads `addrmap NAME { property* reg* };`, and of each `reg { desc; field* } NAME @ N;`.
class RdlReader {
 public:
  explicit RdlReader(const std::string& text) : tokens_(rdl_tokens(text)) {}

  std::vector<Told> read() {
    std::vector<Told> registers;
    expect({"addrmap", "hopmesh", "{"});
    while (peek() != "reg") property();
    while (peek() == "reg") registers.push_back(read_register());
    expect({"}", ";"});
    EXPECT_EQ(at_, tokens_.size());
    return registers;
  }
  std::map<std::string, std::string> properties;

 private:
  Told read_register() {
    Told t;
    properties.clear();
    expect({"reg", "{"});
    while (peek() != "field") property();
    t.meaning = properties["desc"];
    while (peek() == "field") t.fields.push_back(read_field());
    expect({"}"});
    t.name = next();
    expect({"@"});
    t.offset = number(next());
    expect({";"});
    return t;
  }

  Told read_field() {
    Told t;
    properties.clear();
    expect({"field", "{"});
    while (peek() != "}") property();
    t.meaning = properties["desc"];
    t.access = properties["sw"] == "r" ? "RO" : properties["sw"] == "w" ? "WO" : "RW";
    if (properties["onwrite"] == "woclr") t.access = "W1C";
    expect({"}"});
    t.name = next();
    expect({"["});
    const std::uint32_t highest = number(next());
    expect({":"});
    t.offset = number(next());
    t.width = highest - t.offset + 1;
    expect({"]"});
    if (peek() == "=") {
      next();
      t.reset = number(next());
    }
    expect({";"});
    return t;
  }

  /// name = value; or a name alone; `default` may stand before it.
  void property() {
    if (peek() == "default") next();
    const std::string name = next();
    std::string value = "true";
    if (peek() == "=") {
      next();
      value = next();
      if (value.front() == '"') value = value.substr(1, value.size() - 2);
    }
    properties[name] = value;
    expect({";"});
  }

  std::string peek() const { return at_ < tokens_.size() ? tokens_[at_] : "the end"; }
  std::string next() {
    const std::string token = peek();
    at_ += 1;
    return token;
  }
  void expect(const std::vector<std::string>& wanted) {
    for (const std::string& token : wanted) {
      const std::string found = next();
      if (found != token) throw std::runtime_error("found " + found + ", expected " + token);
    }
  }

  const std::vector<std::string> tokens_;
  std::size_t at_ = 0;
};

TEST(Descriptions, SystemRdlTellsTheTable) {
  EXPECT_EQ(RdlReader(file_text("rdl")).read(), table(false, true, false));
}

} // namespace
} // namespace hopmesh::tests
