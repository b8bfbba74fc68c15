#include "sim/scene/obj_lines.h"

#include <algorithm>
#include <array>

namespace hopmesh::scene {

namespace {

/// Statements of numbers. Others are names and paths, whose last backslash may be their own.
constexpr std::array<std::string_view, 23> of_numbers{
    "v",    "vt",   "vn",   "vp",    "f",    "fo",   "l",    "p",  "deg", "bmat", "step", "cstype",
    "curv", "surf", "parm", "curv2", "trim", "hole", "scrv", "sp", "con", "bzp",  "bsp"};

/// A # begins a comment where a word may begin; elsewhere it is part of one, as in the 1.#IND of old Windows
/// programs.
std::string_view without_comment(std::string_view line) {
  for (auto at = line.find('#'); at != std::string_view::npos; at = line.find('#', at + 1))
    if (at == 0 || input::is_blank(line[at - 1])) return line.substr(0, at);
  return line;
}

/// Without the backslash that ends it, and what is blank behind that.
bool take_backslash(std::string_view& statement) {
  std::size_t size = statement.size();
  while (size > 0 && input::is_blank(statement[size - 1])) --size;
  if (size == 0 || statement[size - 1] != '\\') return false;
  statement = statement.substr(0, size - 1);
  return true;
}

bool is_of_numbers(std::string_view statement) {
  const std::string_view keyword = input::Words(statement).next();
  return std::find(of_numbers.begin(), of_numbers.end(), keyword) != of_numbers.end();
}

} // namespace

bool ObjLines::next() {
  if (!lines_.next()) return false;
  number_ = lines_.number();
  statement_ = without_comment(lines_.line());
  std::string_view first = statement_;
  if (take_backslash(first) && is_of_numbers(first)) join_lines();
  words_ = input::Words(statement_);
  keyword_ = words_.next();
  return true;
}

void ObjLines::join_lines() {
  joined_.clear();
  for (bool goes_on = true; goes_on;) {
    goes_on = take_backslash(statement_);
    joined_.append(statement_) += ' ';
    if (!goes_on || !lines_.next()) break;
    statement_ = without_comment(lines_.line());
  }
  statement_ = joined_;
}

} // namespace hopmesh::scene
