// A TOML file and its overrides as one flat map from key path to value, each value with the place it came
// from.
#pragma once

#include "sim/input/input_error.h"

#include <cstdint>
#include <map>
#include <variant>

namespace hopmesh::input {

struct TomlTable {}; ///< its keys are entries of their own
struct TomlDate {};  ///< nothing here is a date; kept to be able to say so

/// A value; line 0 means that an override set it.
struct TomlValue {
  std::variant<TomlTable, TomlDate, std::string, std::int64_t, double, bool, std::vector<TomlValue>> data;
  int line = 0;

  template <typename T> const T* as() const { return std::get_if<T>(&data); }
};

/// "20", "\"left\"", "a table", ...: the value as messages name it.
std::string describe(const TomlValue& value);

class TomlSource {
 public:
  /// No file: every key keeps its default, or what an override gives it.
  TomlSource() = default;
  /// `kind` says in messages what the file should have been.
  static TomlSource read(const std::string& path, const std::string& kind);
  /// From a text that stands in the file `path`.
  static TomlSource of_text(const std::string& text, const std::string& path);

  /// An override: the value is TOML, or a bare string where it is no TOML.
  void set(const std::string& key, const std::string& text);
  /// Forgets a key and everything under it.
  void erase(const std::string& key);

  /// Every key path, tables too, ascending.
  const std::map<std::string, TomlValue>& values() const { return values_; }
  const TomlValue* find(const std::string& key) const;
  bool overridden() const { return overridden_; }

  /// "--set" for what an override set, else the file.
  std::string file_of(int line) const;
  /// The mistake of one value, with its place.
  InputError error(const TomlValue& value, const std::string& key, const std::string& expected,
                   const std::string& nearest = "") const;

 private:
  std::string path_;
  std::map<std::string, TomlValue> values_;
  bool overridden_ = false;
};

/// Splits "key.path=value"; throws InputError where that is not its shape.
std::pair<std::string, std::string> split_override(const std::string& text);

} // namespace hopmesh::input
