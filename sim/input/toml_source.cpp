// The only place that knows toml++: parses, flattens tables to key paths, keeps the line of every value.
#include "sim/input/toml_source.h"

#include "sim/input/whole_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <toml++/toml.h>

namespace hopmesh::input {

namespace {

constexpr std::size_t most_toml_bytes = 1 << 20;
constexpr int most_dots = 1000; // toml++ nests and frees tables by recursion, one level a dot
constexpr int deepest_key = 8;  // nothing we know is deeper than three
const std::string override_file = "--set";

using Values = std::map<std::string, TomlValue>;

bool is_bare(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
}

/// A key that is not plain is put in quotes, so that "mesh.grid" as one quoted key is not taken for
/// mesh.grid.
std::string joined(const std::string& prefix, std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
  return (prefix.empty() ? "" : prefix + ".") + (bare ? std::string(key) : in_quotes(key));
}

int line_of(const toml::node& node) {
  return static_cast<int>(node.source().begin.line);
}

TomlValue value_of(const toml::node& node, bool override) {
  TomlValue value;
  value.line = override ? 0 : line_of(node);
  if (const auto* text = node.as_string())
    value.data = text->get();
  else if (const auto* whole = node.as_integer())
    value.data = whole->get();
  else if (const auto* real = node.as_floating_point())
    value.data = real->get();
  else if (const auto* flag = node.as_boolean())
    value.data = flag->get();
  else if (const auto* list = node.as_array()) {
    std::vector<TomlValue> items;
    for (const toml::node& item : *list) items.push_back(value_of(item, override));
    value.data = std::move(items);
  } else if (!node.is_table())
    value.data = TomlDate{};
  return value;
}

InputError too_deep(const std::string& file, int line, const std::string& key) {
  return input_error(file, line, key, fmt::format("a key more than {} levels deep", deepest_key),
                     "a known key");
}

struct Flattening {
  std::string file;
  bool override;
  Values& values;

  void table(const toml::table& from, const std::string& prefix, int depth) {
    for (const auto& [key, node] : from) {
      const std::string path = joined(prefix, key.str());
      if (depth == deepest_key) throw too_deep(file, override ? 0 : line_of(node), path);
      values[path] = value_of(node, override);
      if (const toml::table* inner = node.as_table()) table(*inner, path, depth + 1);
    }
  }
};

/// toml++ would exhaust the stack on absurdly long dotted keys.
void refuse_dots(const std::string& text, const std::string& file) {
  int line = 1, dots = 0;
  for (char c : text) {
    if (c == '\n') ++line, dots = 0;
    if (c == '.' && ++dots > most_dots)
      throw input_error(file, line, "", fmt::format("more than {} dots in a line", most_dots),
                        "at most that many");
  }
}

/// The parser's own sentence, in one line and with its place.
toml::table parse(const std::string& text, const std::string& file) {
  refuse_dots(text, file);
  try {
    return toml::parse(std::string_view(text));
  } catch (const toml::parse_error& error) {
    const int line = static_cast<int>(error.source().begin.line);
    throw input_error(file, line, std::string(error.description()), "", "");
  }
}

/// What follows the = of an override: a TOML value if it is one, else the text itself.
toml::table parse_override(const std::string& text) {
  try {
    toml::table parsed = parse("value = " + text, override_file);
    if (parsed.size() == 1) return parsed; // more: a line break smuggled in other keys
  } catch (const InputError&) {
  }
  return toml::table{{"value", text}};
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

bool is_key_path(const std::string& key) {
  const auto part_ends = [](char a, char b) { return a == '.' && b == '.'; };
  return !key.empty() && key.front() != '.' && key.back() != '.' &&
         std::all_of(key.begin(), key.end(), [](char c) { return is_bare(c) || c == '.'; }) &&
         std::adjacent_find(key.begin(), key.end(), part_ends) == key.end();
}

} // namespace

std::string describe(const TomlValue& value) {
  if (value.as<TomlTable>()) return "a table";
  if (value.as<TomlDate>()) return "a date or time";
  if (const auto* list = value.as<std::vector<TomlValue>>()) return fmt::format("a list of {}", list->size());
  if (const auto* flag = value.as<bool>()) return *flag ? "true" : "false";
  if (const auto* whole = value.as<std::int64_t>()) return std::to_string(*whole);
  if (const auto* real = value.as<double>()) return fmt::format("{:#}", *real); // 3.0, not 3
  return in_quotes(*value.as<std::string>());
}

TomlSource TomlSource::read(const std::string& path, const std::string& kind) {
  return of_text(read_whole_file(path, kind, most_toml_bytes), path);
}

TomlSource TomlSource::of_text(const std::string& text, const std::string& path) {
  TomlSource source;
  source.path_ = path;
  const toml::table root = parse(text, path);
  Flattening{path, false, source.values_}.table(root, "", 0);
  return source;
}

void TomlSource::set(const std::string& key, const std::string& text) {
  overridden_ = true;
  erase(key);
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', dot + 1)) {
    TomlValue& parent = values_[key.substr(0, dot)];
    if (!parent.as<TomlTable>()) parent = TomlValue{};
  }
  const toml::table parsed = parse_override(text);
  const toml::node& node = *parsed.get("value");
  values_[key] = value_of(node, true);
  if (const toml::table* inner = node.as_table())
    Flattening{override_file, true, values_}.table(*inner, key, 1);
}

void TomlSource::erase(const std::string& key) {
  values_.erase(key);
  const std::string below = key + ".";
  auto entry = values_.lower_bound(below);
  while (entry != values_.end() && entry->first.compare(0, below.size(), below) == 0)
    entry = values_.erase(entry);
}

const TomlValue* TomlSource::find(const std::string& key) const {
  const auto entry = values_.find(key);
  return entry == values_.end() ? nullptr : &entry->second;
}

std::string TomlSource::file_of(int line) const {
  return line == 0 ? override_file : path_;
}

InputError TomlSource::error(const TomlValue& value, const std::string& key, const std::string& expected,
                             const std::string& nearest) const {
  return input_error(file_of(value.line), value.line, key, describe(value), expected, nearest);
}

std::pair<std::string, std::string> split_override(const std::string& text) {
  const auto equals = text.find('=');
  const std::string key = equals == std::string::npos ? "" : trimmed(text.substr(0, equals));
  if (!is_key_path(key)) throw input_error(override_file, 0, "", in_quotes(text), "key.path=value");
  if (std::count(key.begin(), key.end(), '.') >= deepest_key) throw too_deep(override_file, 0, key);
  return {key, trimmed(text.substr(equals + 1))};
}

} // namespace hopmesh::input
