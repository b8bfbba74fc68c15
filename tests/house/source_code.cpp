#include "tests/house/source_code.h"

#include <algorithm>
#include <cctype>
#include <regex>

namespace hopmesh::tests {

namespace {

std::size_t line_at(const std::string& text, std::size_t at) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

/// What comes at `at`: a comment, a string, a character, or plain code (a length of 0).
struct Token {
  enum Kind { comment, string, character, code } kind = code;
  std::size_t length = 0;
};

/// What ends with `end`, which no backslash takes its meaning.
std::size_t quoted(const std::string& text, std::size_t at, char end) {
  std::size_t last = at + 1;
  while (last < text.size() && text[last] != end) last += text[last] == '\\' ? 2 : 1;
  return last + 1 - at;
}

Token token_at(const std::string& text, std::size_t at) {
  const bool in_word =
      at > 0 && (std::isalnum(static_cast<unsigned char>(text[at - 1])) || text[at - 1] == '_');
  const auto up_to = [&](const std::string& end) {
    const std::size_t last = text.find(end, at + 2);
    return (last == std::string::npos ? text.size() : last + end.size()) - at;
  };
  if (text.compare(at, 2, "//") == 0) return {Token::comment, up_to("\n") - 1};
  if (text.compare(at, 2, "/*") == 0) return {Token::comment, up_to("*/")};
  if (text.compare(at, 2, "R\"") == 0 && !in_word)
    return {Token::string, up_to(")" + text.substr(at + 2, text.find('(', at) - at - 2) + "\"")};
  if (text[at] == '"') return {Token::string, quoted(text, at, '"')};
  if (text[at] == '\'' && !in_word) return {Token::character, quoted(text, at, '\'')}; // no 1'000
  return {};
}

/// A comment's words, without the slashes.
std::string words_of_comment(const std::string& text) {
  static const std::regex slashes(R"(^/[/*][/!*]?<?\s*|\s*\*/$)");
  return std::regex_replace(text, slashes, "");
}

} // namespace

Code code_of(const std::string& text) {
  Code code{text, {}, {}};
  std::size_t line_of_last = 0; // of the last comment that had its line for itself
  for (std::size_t at = 0; at < text.size();) {
    const Token token = token_at(text, at);
    if (token.kind == Token::code) {
      ++at;
      continue;
    }
    const std::string whole = text.substr(at, token.length);
    const std::size_t line = line_at(text, at);
    if (token.kind == Token::string) code.strings.push_back({line, whole.substr(1, whole.size() - 2)});
    if (token.kind == Token::comment) {
      const std::size_t start = text.rfind('\n', at) + 1; // 0 in the first line
      const bool alone = text.find_first_not_of(' ', start) == at;
      if (alone && line_of_last + 1 == line && !code.comments.empty())
        code.comments.back().text += " " + words_of_comment(whole);
      else
        code.comments.push_back({line, words_of_comment(whole)});
      if (alone) line_of_last = line;
    }
    for (std::size_t k = at; k < at + token.length; ++k)
      if (code.bare[k] != '\n') code.bare[k] = token.kind == Token::comment ? ' ' : '_';
    at += token.length;
  }
  return code;
}

namespace {

enum class Block { scope, function, other };

/// Judged by the words before its brace.
Block block_of(const std::string& words) {
  static const std::regex scope(R"(\b(namespace|class|struct|union|enum|extern)\b)");
  const char last = words[words.find_last_not_of(" \n")];
  if (std::regex_search(words, scope) && last != ')') return Block::scope;
  return words.find('(') != std::string::npos && last != '=' ? Block::function : Block::other;
}

std::string without_preprocessor(std::string code) {
  bool inside = false;
  for (std::size_t start = 0, end; start < code.size(); start = end + 1) {
    end = std::min(code.find('\n', start), code.size());
    const std::size_t first = code.find_first_not_of(' ', start);
    inside = inside || (first < end && code[first] == '#');
    const bool goes_on = inside && end > start && code[end - 1] == '\\';
    if (inside)
      std::fill(code.begin() + static_cast<long>(start), code.begin() + static_cast<long>(end), ' ');
    inside = goes_on;
  }
  return code;
}

} // namespace

std::vector<Function> functions_of(const Code& code) {
  const std::string bare = without_preprocessor(code.bare);
  std::vector<Function> functions;
  std::vector<std::pair<Block, std::size_t>> open; // and where each head begins
  std::size_t head = 0;
  int parentheses = 0;
  for (std::size_t at = 0; at < bare.size(); ++at) {
    const char c = bare[at];
    parentheses += (c == '(') - (c == ')');
    if (c == '{') {
      const bool outside = open.empty() || open.back().first == Block::scope;
      const bool apart = parentheses == 0 && at > 0 && std::isspace(static_cast<unsigned char>(bare[at - 1]));
      const Block block = outside && apart ? block_of(bare.substr(head, at - head)) : Block::other;
      open.emplace_back(block, bare.find_first_not_of(" \n", head));
    }
    if (c == '}' && !open.empty()) {
      const std::size_t first = line_at(bare, open.back().second);
      if (open.back().first == Block::function) functions.push_back({first, line_at(bare, at) - first + 1});
      open.pop_back();
    }
    if (c == '{' || c == '}' || (c == ';' && parentheses == 0)) head = at + 1;
  }
  return functions;
}

std::vector<std::string> sentences_of(const std::string& comment) {
  static const std::regex end(R"([.!?:] +(?=[A-Z]))");
  return {std::sregex_token_iterator(comment.begin(), comment.end(), end, -1), {}};
}

} // namespace hopmesh::tests
