// Study files: the fixed keys by KeyReader's rules, and axes, whose names are keys of scenes and arrays.
#include "sim/study/study_file.h"

#include "sim/input/key_reader.h"
#include "sim/input/shipped.h"
#include "sim/input/whole_file.h"
#include "sim/levels/level.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 1 << 20, most_points = 1'000'000;
const std::string axes_table = "axes.";

std::string without_quotes(std::string key) {
  key.erase(std::remove(key.begin(), key.end(), '"'), key.end());
  return key;
}

std::string in_toml_quotes(const std::string& text) {
  std::string out = "\"";
  for (char c : text) out += (c == '"' || c == '\\' ? std::string("\\") : std::string()) + c;
  return out + '"';
}

/// A value as an override takes it back.
std::string toml_text(const input::TomlValue& value) {
  if (const auto* text = value.as<std::string>()) return in_toml_quotes(*text);
  if (const auto* real = value.as<double>()) return fmt::format("{}", *real); // describe's 3.e-05 is no TOML
  const auto* items = value.as<std::vector<input::TomlValue>>();
  if (!items) return input::describe(value);
  std::vector<std::string> texts;
  for (const input::TomlValue& item : *items) texts.push_back(toml_text(item));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string label_of(const input::TomlValue& value) {
  if (const auto* text = value.as<std::string>()) return *text;
  if (const auto* real = value.as<double>()) return fmt::format("{}", *real);
  return toml_text(value);
}

std::string filled(std::string pattern, const std::string& label) {
  for (auto at = pattern.find("{}"); at != std::string::npos; at = pattern.find("{}", at + label.size()))
    pattern.replace(at, 2, label);
  return pattern;
}

using Items = std::vector<input::TomlValue>;

class StudyReader {
 public:
  StudyReader(const input::TomlSource& source, const std::string& path) : source_(source), keys_(source) {
    study_.path = path;
    study_.name = fs::path(path).stem().string();
  }

  Study read() {
    keys_.text("name", study_.name, "a name in quotes");
    if (!keys_.text("scene", study_.scene, "a scene file or the name of a shipped scene"))
      throw input::input_error(study_.path, 0, "scene", "nothing",
                               "a scene file or the name of a shipped scene");
    keys_.text("array", study_.array, "an array file or the name of a preset");
    study_.scene = beside(study_.scene);
    study_.array = beside(study_.array);
    keys_.integer("steps", study_.steps, 1, 1'000'000'000);
    read_methods();
    read_times();
    read_axes();
    check_methods();
    keys_.refuse_unknown();
    if (study_.combinations() > most_points)
      throw input::input_error(study_.path, 0, "axes", fmt::format("{} points", study_.combinations()),
                               fmt::format("at most {}", most_points));
    return study_;
  }

 private:
  /// A path is meant from the study's folder; a word is a name.
  std::string beside(const std::string& name) const {
    const bool is_path = name.find('/') != std::string::npos || fs::path(name).extension() == ".toml";
    return is_path ? fs::absolute(fs::path(study_.path).parent_path() / name).lexically_normal().string()
                   : name;
  }

  const Items& list_at(const input::TomlValue& value, const std::string& key) const {
    const auto* items = value.as<Items>();
    if (!items || items->empty()) throw source_.error(value, key, "a list of at least one value");
    return *items;
  }

  void read_methods() {
    const input::TomlValue* found = keys_.value("methods");
    if (!found) {
      study_.methods = {levels::default_level().name};
      return;
    }
    study_.methods_line = found->line;
    for (const input::TomlValue& item : list_at(*found, "methods")) {
      if (!item.as<std::string>()) throw source_.error(item, "methods", "names of methods, in quotes");
      study_.methods.push_back(*item.as<std::string>());
      if (std::count(study_.methods.begin(), study_.methods.end(), study_.methods.back()) > 1)
        throw source_.error(item, "methods", "each method once");
    }
  }

  void read_times() {
    const input::TomlValue* found = keys_.value("times");
    if (!found) return;
    study_.times_line = found->line;
    for (const input::TomlValue& item : list_at(*found, "times")) {
      const double time = keys_.number(item, "times", input::above_zero);
      if (!study_.times.empty() && time <= study_.times.back())
        throw source_.error(item, "times", "each time after the one before");
      study_.times.push_back(time);
    }
  }

  /// Every key under [axes] is a list, or belongs to a table with labels: an axis that sets several keys.
  void read_axes() {
    keys_.value("axes");
    if (const input::TomlValue* axes = source_.find("axes"); axes && !axes->as<input::TomlTable>())
      throw source_.error(*axes, "axes", "a table");
    for (const auto& [path, value] : source_.values()) {
      if (path.compare(0, axes_table.size(), axes_table) != 0) continue;
      keys_.value(path);
      const std::string name = path.substr(axes_table.size());
      if (value.as<input::TomlTable>()) {
        if (source_.find(path + ".label")) read_combined(path, without_quotes(name));
      } else if (!in_combined(path)) {
        read_plain(value, path, without_quotes(name));
      }
    }
    std::stable_sort(study_.axes.begin(), study_.axes.end(),
                     [](const StudyAxis& a, const StudyAxis& b) { return a.line < b.line; });
  }

  /// Methods are named once: by the study, or by one of its axes.
  void check_methods() const {
    int axes = study_.methods_line > 0;
    for (const StudyAxis& axis : study_.axes)
      if (const AxisPlace& place = axis.places.front(); place.method_line > 0 && axes++ > 0)
        throw input::input_error(study_.path, place.method_line, "axes." + axis.name + ".method",
                                 "methods named twice", "either methods, or the method of one axis");
  }

  bool in_combined(const std::string& path) const {
    for (auto dot = path.find('.', axes_table.size()); dot != std::string::npos;
         dot = path.find('.', dot + 1))
      if (source_.find(path.substr(0, dot) + ".label")) return true;
    return false;
  }

  void read_plain(const input::TomlValue& value, const std::string& path, const std::string& key) {
    StudyAxis axis{key, value.line, {}};
    for (const input::TomlValue& item : list_at(value, path))
      axis.places.push_back({label_of(item), {{key, toml_text(item), value.line}}, {}, 0});
    study_.axes.push_back(std::move(axis));
  }

  void read_combined(const std::string& table, const std::string& name) {
    const input::TomlValue& labels = *source_.find(table + ".label");
    StudyAxis axis{name, labels.line, {}};
    for (const input::TomlValue& item : list_at(labels, table + ".label"))
      axis.places.push_back({label_of(item), {}, {}, 0});
    const std::string below = table + '.';
    for (const auto& [path, value] : source_.values())
      if (path.compare(0, below.size(), below) == 0 && path != table + ".label" &&
          !value.as<input::TomlTable>())
        set_along(axis, value, path, without_quotes(path.substr(below.size())));
    study_.axes.push_back(std::move(axis));
  }

  /// A list: one value a place. Anything else: the same everywhere, with {} in a text for the label.
  void set_along(StudyAxis& axis, const input::TomlValue& value, const std::string& path,
                 const std::string& key) {
    const auto* items = value.as<Items>();
    if (items && items->size() != axis.places.size())
      throw source_.error(value, path, fmt::format("a list of {}, one a label", axis.places.size()));
    for (std::size_t k = 0; k < axis.places.size(); ++k) {
      AxisPlace& place = axis.places[k];
      if (key == "method") {
        const input::TomlValue& name = items ? (*items)[k] : value;
        if (!name.as<std::string>()) throw source_.error(name, path, "names of methods, in quotes");
        place.method = *name.as<std::string>(), place.method_line = value.line;
        continue;
      }
      const auto* pattern = value.as<std::string>();
      const std::string text =
          pattern ? in_toml_quotes(filled(*pattern, place.label)) : toml_text(items ? (*items)[k] : value);
      place.settings.push_back({key, text, value.line});
    }
  }

  const input::TomlSource& source_;
  input::KeyReader keys_;
  Study study_;
};

} // namespace

std::size_t Study::combinations() const {
  std::size_t count = methods.size();
  for (const StudyAxis& axis : axes) count = std::min(count * axis.places.size(), most_points + 1);
  return count;
}

Study study_of(const std::string& text, const std::string& path) {
  const input::TomlSource source = input::TomlSource::of_text(text, path);
  Study study = StudyReader(source, path).read();
  study.text = text;
  return study;
}

Study read_study(const std::string& study) {
  const std::string path = input::path_of(study, input::Shipped::study);
  return study_of(input::read_whole_file(path, "a study file", most_bytes), path);
}

} // namespace hopmesh::study
