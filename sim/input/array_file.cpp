// An array file starts from a preset and changes what it names.
#include "sim/input/array_file.h"

#include "rtl_model/spec/array_rules.h"
#include "rtl_model/spec/presets.h"
#include "sim/input/key_table.h"
#include "sim/input/utf8.h"

#include <filesystem>

namespace hopmesh::input {

namespace {

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const spec::ArraySpec& a : spec::presets()) names.push_back(a.name);
  return names;
}

/// The key that starts an array from another one; it is never written.
Special start_of(spec::ArraySpec& a) {
  const auto read = [&a](const TomlSource& source, const TomlValue& value) {
    const auto* name = value.as<std::string>();
    const auto found = name ? spec::preset(*name) : std::nullopt;
    const auto names = preset_names();
    if (!found) throw source.error(value, "preset", one_of(names), name ? nearest_name(*name, names) : "");
    a = *found;
  };
  return {read, [] { return std::string(); }};
}

/// A rule may be broken by a key that was left as it was; then there is no line to name.
void check_rules(const TomlSource& source, const std::string& file, const spec::ArraySpec& a,
                 spec::ArrayTable table) {
  const auto fault = spec::validate(a, 1, table);
  if (!fault) return;
  if (const TomlValue* place = source.find(fault->key))
    throw source.error(*place, fault->key, fault->expected);
  throw input_error(file.empty() ? "--set" : file, 0, fault->key, fault->found, fault->expected);
}

/// What the keys of a source make of an array that had `a` before.
spec::ArraySpec changed(spec::ArraySpec a, const TomlSource& source, const std::string& file,
                        spec::ArrayTable table) {
  KeyReader reader(source);
  read_keys(reader, array_file_keys(a, table));
  reader.refuse_unknown();
  if (!source.find("name") && !file.empty())
    expect_utf8("array", a.name = std::filesystem::path(file).stem().string());
  else if (!source.find("name") && source.overridden())
    a.name = "custom"; // no longer what the preset's name promises
  check_rules(source, file, a, table);
  return a;
}

/// A word without a path's marks is the name of a preset, unless a file is called so.
bool is_file(const std::string& array) {
  std::error_code ignored;
  return array.find('/') != std::string::npos || std::filesystem::path(array).extension() == ".toml" ||
         std::filesystem::exists(array, ignored);
}

} // namespace

bool is_array_key(const std::string& key) {
  const std::string table = key.substr(0, key.find('.'));
  return table == "array" || table == "formats";
}

Keys array_file_keys(spec::ArraySpec& a, spec::ArrayTable table) {
  Keys keys{Key("preset", start_of(a), "where to start").unset_is("`\"guarded\"`").allows("a name below"),
            Key("name", &a.name, in_words("a name in quotes"), "of the array")
                .unset_is("the file's name; `custom` once `--set` changed a preset")
                .allows("a line of text")};
  for (const spec::ArrayKey& row : table(a)) {
    const auto place = std::visit([](const auto& at) -> Place { return at; }, row.place);
    keys.emplace_back(row.name, place, row.meaning);
    keys.back().in_unit(row.unit).counts({row.counts, row.counts_with}).allows(row.allowed.words);
  }
  return keys;
}

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
  for (std::string& note : without_effect(source, array_file_keys(a), array_file_keys(fresh)))
    notes.push_back(std::move(note));
  return a;
}

spec::ArraySpec array_of(const TomlSource& source, const std::string& file, spec::ArrayTable table) {
  return changed(spec::default_array(), source, file, table);
}

std::string array_text(spec::ArraySpec array, spec::ArrayTable table) {
  return toml_text(array_file_keys(array, table));
}

} // namespace hopmesh::input
