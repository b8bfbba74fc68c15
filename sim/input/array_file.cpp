// An array file starts from a preset and changes what it names.
#include "sim/input/array_file.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/input/key_reader.h"

#include <algorithm>
#include <filesystem>

namespace hopmesh::input {

namespace {

template <std::size_t n> std::vector<std::string> strings(const std::array<std::string_view, n>& names) {
  return {names.begin(), names.end()};
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const spec::ArraySpec& a : spec::presets()) names.push_back(a.name);
  return names;
}

template <typename Mode, std::size_t n>
void read_mode(KeyReader& keys, const std::string& key, Mode& target,
               const std::array<std::string_view, n>& names) {
  std::string name;
  if (keys.choice(key, name, strings(names))) target = *spec::mode_named<Mode>(name, names);
}

/// The mode name nearest to a word of the text that is none, for formats like fixed<16,2,SC_RDN>.
std::string nearest_mode(const std::string& text) {
  std::vector<std::string> valid = strings(spec::rounding_names);
  for (std::string_view name : spec::overflow_names) valid.emplace_back(name);
  for (auto start = text.find(','); start != std::string::npos; start = text.find(',', start + 1)) {
    const auto end = text.find_first_of(",>", start + 1);
    const std::string word = text.substr(start + 1, end == std::string::npos ? end : end - start - 1);
    std::string nearest = nearest_name(word, valid);
    if (!nearest.empty() && nearest != word) return nearest;
  }
  return "";
}

std::optional<spec::NumberFormat> format_in(const TomlValue& value) {
  constexpr std::size_t longest = 80; // the regular expression behind parse_format recurses over its text
  const auto* text = value.as<std::string>();
  return text && text->size() <= longest ? spec::parse_format(*text) : std::nullopt;
}

void read_format(const TomlSource& source, KeyReader& keys, const std::string& key,
                 spec::NumberFormat& target) {
  const TomlValue* found = keys.value(key);
  if (!found) return;
  const auto format = format_in(*found);
  const auto* text = found->as<std::string>();
  if (!format)
    throw source.error(*found, key, "a format such as \"fixed<16,2,SC_RND,SC_SAT>\"",
                       text ? nearest_mode(*text) : "");
  target = *format;
}

void read_accumulator(const TomlSource& source, KeyReader& keys, spec::ArraySpec& a) {
  const std::string key = "formats.accumulator";
  const TomlValue* found = keys.value(key);
  if (!found) return;
  const auto* text = found->as<std::string>();
  a.exact_accumulator = text && *text == "exact";
  if (a.exact_accumulator) return;
  if (!format_in(*found))
    throw source.error(*found, key, "\"exact\" or a format such as \"fixed<40,12,SC_TRN,SC_SAT>\"");
  read_format(source, keys, key, a.formats.accumulator);
}

/// Any integer: the rules of the spec say which can be built, and none of them reaches this far.
void read_integer(const TomlSource& source, KeyReader& keys, const std::string& key, int& target) {
  constexpr std::int64_t far = 1'000'000;
  const TomlValue* found = keys.value(key);
  if (!found) return;
  const auto* whole = found->as<std::int64_t>();
  if (!whole) throw source.error(*found, key, "an integer");
  target = static_cast<int>(std::clamp(*whole, -far, far));
}

void read_array_table(const TomlSource& source, KeyReader& keys, spec::ArraySpec& a) {
  read_mode(keys, "array.schedule", a.schedule, spec::schedule_names);
  read_mode(keys, "array.output", a.output, spec::output_names);
  read_mode(keys, "array.normaliser", a.normaliser, spec::normaliser_names);
  read_integer(source, keys, "array.lanes", a.lanes);
  read_integer(source, keys, "array.reciprocal_bits", a.reciprocal_bits);
  read_integer(source, keys, "array.bus_bits", a.bus_bits);
  keys.real("array.clock_mhz", a.clock_mhz, any_number);
}

void read_formats_table(const TomlSource& source, KeyReader& keys, spec::ArraySpec& a) {
  read_format(source, keys, "formats.weight", a.formats.weight);
  read_format(source, keys, "formats.bias", a.formats.bias);
  read_accumulator(source, keys, a);
  read_format(source, keys, "formats.drive", a.formats.drive);
  read_format(source, keys, "formats.state", a.formats.state);
  read_format(source, keys, "formats.link", a.formats.link);
}

/// A rule may be broken by a key that was left as it was; then there is no line to name.
void check_rules(const TomlSource& source, const std::string& file, const spec::ArraySpec& a) {
  const auto fault = spec::validate(a);
  if (!fault) return;
  if (const TomlValue* place = source.find(fault->key))
    throw source.error(*place, fault->key, fault->expected);
  throw input_error(file.empty() ? "--set" : file, 0, fault->key, fault->found, fault->expected);
}

/// What the keys of a source make of an array that had `a` before.
spec::ArraySpec changed(spec::ArraySpec a, const TomlSource& source, const std::string& file) {
  KeyReader keys(source);
  std::string name;
  if (keys.choice("preset", name, preset_names())) a = *spec::preset(name);
  if (!file.empty())
    a.name = std::filesystem::path(file).stem().string();
  else if (source.overridden())
    a.name = "custom"; // no longer what the preset's name promises
  keys.text("name", a.name, "a name in quotes");
  read_array_table(source, keys, a);
  read_formats_table(source, keys, a);
  keys.refuse_unknown();
  check_rules(source, file, a);
  return a;
}

/// A word without a path's marks is the name of a preset, unless a file is called so.
bool is_file(const std::string& array) {
  std::error_code ignored;
  return array.find('/') != std::string::npos || std::filesystem::path(array).extension() == ".toml" ||
         std::filesystem::exists(array, ignored);
}

} // namespace

spec::ArraySpec read_array(const std::string& array,
                           const std::vector<std::pair<std::string, std::string>>& overrides) {
  const auto named = array.empty() ? spec::default_array() : spec::preset(array);
  if (!named && !is_file(array))
    throw input_error("", 0, "array", in_quotes(array), "an array file, or " + one_of(preset_names()),
                      nearest_name(array, preset_names()));
  TomlSource source = named ? TomlSource() : TomlSource::read(array, "an array file");
  for (const auto& [key, text] : overrides) source.set(key, text);
  return changed(named.value_or(spec::default_array()), source, named ? "" : array);
}

spec::ArraySpec array_of(const TomlSource& source, const std::string& file) {
  return changed(spec::default_array(), source, file);
}

} // namespace hopmesh::input
