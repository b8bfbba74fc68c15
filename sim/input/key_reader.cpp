// A function per kind of value; each knows how to say what it expected.
#include "sim/input/key_reader.h"

#include "sim/input/utf8.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::input {

namespace {

std::string last_part(const std::string& key) {
  return key.substr(key.rfind('.') + 1); // npos + 1 is 0: the whole key
}

/// Names and paths end up in titles, tables and messages of one line.
bool has_control(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

} // namespace

const TomlValue* KeyReader::value(const std::string& key) {
  known_.insert(key);
  return source_.find(key);
}

double KeyReader::number(const TomlValue& value, const std::string& key, const Range& range) const {
  const auto* whole = value.as<std::int64_t>();
  const auto* real = value.as<double>();
  if (!whole && !real) throw source_.error(value, key, range.words);
  const double x = real ? *real : static_cast<double>(*whole);
  if (!(x >= range.low && x <= range.high)) throw source_.error(value, key, range.words); // NaN too
  return x;
}

bool KeyReader::integer(const std::string& key, std::int64_t& target, std::int64_t low, std::int64_t high) {
  const TomlValue* found = value(key);
  if (!found) return false;
  const auto* whole = found->as<std::int64_t>();
  if (!whole || *whole < low || *whole > high)
    throw source_.error(*found, key, fmt::format("an integer from {} to {}", low, high));
  target = *whole;
  return true;
}

bool KeyReader::text(const std::string& key, std::string& target, const std::string& expected) {
  const TomlValue* found = value(key);
  if (!found) return false;
  const auto* words = found->as<std::string>();
  if (!words || words->empty() || has_control(*words) || !is_utf8(*words))
    throw source_.error(*found, key, expected);
  target = *words;
  return true;
}

bool KeyReader::known_table(const std::string& key) const {
  const auto below = known_.lower_bound(key + ".");
  return below != known_.end() && below->compare(0, key.size() + 1, key + ".") == 0;
}

void KeyReader::refuse_unknown() const {
  const std::pair<const std::string, TomlValue>* first = nullptr;
  for (const auto& entry : source_.values()) {
    const auto& [key, value] = entry;
    const bool table = value.as<TomlTable>();
    if (known_.count(key) || (table && known_table(key))) continue;
    const auto below = source_.values().lower_bound(key + ".");
    if (table && below != source_.values().end() && below->first.compare(0, key.size() + 1, key + ".") == 0)
      continue; // the key inside it says more
    if (!first || value.line < first->second.line) first = &entry;
  }
  if (first) throw unknown(first->first, first->second);
}

/// A right name in the wrong table is likelier than two typing mistakes.
InputError KeyReader::unknown(const std::string& key, const TomlValue& value) const {
  if (known_table(key)) return source_.error(value, key, "a table");
  const std::vector<std::string> valid(known_.begin(), known_.end());
  std::string nearest = nearest_name(key, valid);
  for (const std::string& candidate : valid)
    if (last_part(candidate) == last_part(key)) nearest = candidate;
  return input_error(source_.file_of(value.line), value.line, key, "an unknown key", siblings(key), nearest);
}

/// The known names in the table of a key, or in the nearest table around it that is known.
std::string KeyReader::siblings(const std::string& key) const {
  const auto dot = key.rfind('.');
  const std::string table = dot == std::string::npos ? "" : key.substr(0, dot);
  if (!table.empty() && !known_table(table)) return siblings(table);
  const std::size_t start = table.empty() ? 0 : table.size() + 1;
  std::set<std::string> names;
  for (const std::string& name : known_)
    if (start == 0 || name.compare(0, start, table + ".") == 0)
      names.insert(name.substr(start, name.find('.', start) - start));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string one_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " or " : ", ") + ('"' + names[k] + '"');
  return text;
}

} // namespace hopmesh::input
