// An array file starts from a preset and changes what it names.
#include "sim/input/array_file.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/input/key_table.h"

#include <filesystem>

namespace hopmesh::input {

namespace {

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const spec::ArraySpec& a : spec::presets()) names.push_back(a.name);
  return names;
}

/// The rows of an array as rows of a file. Any number is read; the rules judge it.
Keys file_keys(const spec::ArrayKeys& rows) {
  Keys keys;
  for (const spec::ArrayKey& row : rows) {
    const auto place = std::visit([](const auto& at) -> Place { return at; }, row.place);
    const bool is_text = std::holds_alternative<std::string*>(row.place);
    keys.emplace_back(row.name, place, is_text ? in_words("a name in quotes") : any_number, row.meaning);
    keys.back().in_unit(row.unit).counts({row.counts, row.counts_with}).allows(row.allowed.words);
  }
  return keys;
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
spec::ArraySpec changed(spec::ArraySpec a, const TomlSource& source, const std::string& file,
                        spec::ArrayTable table) {
  KeyReader reader(source);
  if (const auto preset = reader.choice("preset", preset_names())) a = spec::presets()[*preset];
  if (!file.empty())
    a.name = std::filesystem::path(file).stem().string();
  else if (source.overridden())
    a.name = "custom"; // no longer what the preset's name promises
  read_keys(reader, file_keys(table(a)));
  reader.refuse_unknown();
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
                           const std::vector<std::pair<std::string, std::string>>& overrides,
                           std::vector<std::string>& notes) {
  const auto named = array.empty() ? spec::default_array() : spec::preset(array);
  if (!named && !is_file(array))
    throw input_error("", 0, "array", in_quotes(array), "an array file, or " + one_of(preset_names()),
                      nearest_name(array, preset_names()));
  TomlSource source = named ? TomlSource() : TomlSource::read(array, "an array file");
  for (const auto& [key, text] : overrides) source.set(key, text);
  spec::ArraySpec fresh = spec::default_array();
  spec::ArraySpec a = changed(named.value_or(fresh), source, named ? "" : array, spec::array_keys);
  for (std::string& note :
       without_effect(source, file_keys(spec::array_keys(a)), file_keys(spec::array_keys(fresh))))
    notes.push_back(std::move(note));
  return a;
}

spec::ArraySpec array_of(const TomlSource& source, const std::string& file, spec::ArrayTable table) {
  return changed(spec::default_array(), source, file, table);
}

std::string array_text(spec::ArraySpec array, spec::ArrayTable table) {
  return toml_text(file_keys(table(array)));
}

} // namespace hopmesh::input
