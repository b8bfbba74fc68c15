// Writing by the table: TOML that reads back equal, to the last bit of every number.
#include "sim/input/key_table.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace hopmesh::input {

namespace {

/// A value as TOML.
struct Writing {
  /// The shortest digits that read back as the same double, always with a point or an exponent.
  std::string operator()(const double* x) const {
    const std::string digits = fmt::format("{}", *x);
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
  }

  static std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (char c : text) {
      if (c == '"' || c == '\\') out += '\\';
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
        out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
      else
        out += c;
    }
    return out + '"';
  }

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const Part&) const { return ""; }
  std::string operator()(const Special& special) const { return special.text(); }
  std::string operator()(const bool* flag) const { return *flag ? "true" : "false"; }
  std::string operator()(const int* x) const { return std::to_string(*x); }
  std::string operator()(const std::int64_t* x) const { return std::to_string(*x); }
  std::string operator()(const std::string* text) const { return quoted(*text); }
  std::string operator()(const spec::Choice& choice) const { return quoted(choice.name()); }
  std::string operator()(const spec::NumberFormat* format) const { return quoted(format->text()); }
  std::string operator()(const Vector3* v) const {
    return fmt::format("[{}, {}, {}]", (*this)(&(*v)[0]), (*this)(&(*v)[1]), (*this)(&(*v)[2]));
  }
  std::string operator()(const Worded& worded) const {
    return *worded.number ? (*this)(worded.number) : quoted(worded.word);
  }
  std::string operator()(const spec::Accumulator& accumulator) const {
    return quoted(*accumulator.exact ? "exact" : accumulator.format->text());
  }
  template <typename T> std::string operator()(const std::optional<T>* value) const {
    return *value ? (*this)(&**value) : "";
  }
};

/// Lines of a TOML file: a table where the first part of a name changes, and one line for all keys of a table
/// inside it.
class Lines {
 public:
  void add(const std::string& name, const std::string& value) {
    const auto first = name.find('.'), last = name.rfind('.');
    const std::string table = first == std::string::npos ? "" : name.substr(0, first);
    const std::string inner = last == first ? "" : name.substr(first + 1, last - first - 1);
    const std::string key = name.substr(last + 1); // npos + 1 is 0: the whole name
    if (table != table_ || inner != inner_) end_inner();
    if (table != table_) text_ += fmt::format("\n[{}]\n", table);
    if (!inner.empty()) text_ += inner == inner_ ? ", " : inner + " = { ";
    text_ += fmt::format("{} = {}{}", key, value, inner.empty() ? "\n" : "");
    table_ = table, inner_ = inner;
  }

  std::string text() {
    end_inner();
    return text_;
  }

 private:
  void end_inner() {
    if (!inner_.empty()) text_ += " }\n";
    inner_.clear();
  }

  std::string text_, table_, inner_;
};

} // namespace

std::string value_text(const Place& place) {
  return std::visit(Writing(), place);
}

namespace {

std::string table_of(const Key& key) {
  const auto dot = key.name.find('.');
  return dot == std::string::npos ? "" : key.name.substr(0, dot);
}

// TOML refuses a table that is opened twice: rows of a table come together, wherever they stand.
Keys by_table(const Keys& keys) {
  std::vector<std::string> tables;
  for (const Key& key : keys)
    if (std::find(tables.begin(), tables.end(), table_of(key)) == tables.end())
      tables.push_back(table_of(key));
  Keys sorted;
  for (const std::string& table : tables)
    std::copy_if(keys.begin(), keys.end(), std::back_inserter(sorted),
                 [&](const Key& key) { return table_of(key) == table; });
  return sorted;
}

} // namespace

std::string toml_text(const Keys& keys) {
  Lines lines;
  for (const Key& key : by_table(keys)) {
    const std::string value = value_text(key.place);
    const bool never = !key.when.holds && key.when.otherwise != Otherwise::told;
    if (!value.empty() && !never) lines.add(key.name, value);
  }
  return lines.text();
}

bool is_left_out(const Key& key) {
  if (!key.left_out.what) return false;
  const Vector3 none{0, 0, 0};
  if (const auto* at = std::get_if<double*>(&key.place)) return **at == key.left_out.at;
  if (const auto* at = std::get_if<Worded>(&key.place)) return *at->number == key.left_out.at;
  if (const auto* at = std::get_if<Vector3*>(&key.place)) return **at == none;
  if (const auto* at = std::get_if<std::optional<Vector3>*>(&key.place)) return (*at)->value_or(none) == none;
  return false;
}

} // namespace hopmesh::input
