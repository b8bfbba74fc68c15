// A key of an array as a row: its name in files, where its value stands, what may stand there and when it
// counts.
#pragma once

#include "rtl_model/spec/array_spec.h"

#include <iterator>
#include <variant>

namespace hopmesh::spec {

/// Which one of a few names, as its number among them.
struct Choice {
  const std::string_view* names;
  std::size_t count;
  std::uint8_t* at;

  std::string_view name() const { return names[*at]; }
};

template <typename Mode, std::size_t n>
Choice choice(Mode& mode, const std::array<std::string_view, n>& names) {
  static_assert(sizeof(Mode) == 1, "a mode is an enum of one byte");
  return {names.data(), n, reinterpret_cast<std::uint8_t*>(&mode)};
}

/// The accumulator's format, or that it is exact and has none of its own.
struct Accumulator {
  bool* exact;
  NumberFormat* format;
};

/// Where the value of a key stands. (What an array is called is no fact of the hardware.)
using Place = std::variant<bool*, int*, double*, Choice, NumberFormat*, Accumulator>;

/// The value that stands there, as one word.
struct ValueText {
  std::string operator()(const bool* flag) const { return *flag ? "true" : "false"; }
  std::string operator()(const int* x) const { return std::to_string(*x); }
  std::string operator()(const double* x) const { return std::to_string(*x); }
  std::string operator()(const Choice& choice) const { return std::string(choice.name()); }
  std::string operator()(const NumberFormat* format) const { return format->text(); }
  std::string operator()(const Accumulator& sum) const { return *sum.exact ? "exact" : sum.format->text(); }
};

/// Which numbers can be built, and the words for them: from `least` (`above` it) to `most`, or only those of
/// a list. Of formats, words alone.
struct Allowed {
  std::string words;
  double least = 0, most = 0;
  bool above = false;
  std::vector<int> only = {};

  bool takes(double x) const {
    if (!only.empty()) return std::find(only.begin(), only.end(), x) != only.end();
    return (above ? x > least : x >= least) && x <= most;
  }
  /// Whatever is no number is taken.
  bool takes(const Place& place) const {
    if (const auto* whole = std::get_if<int*>(&place)) return takes(**whole);
    if (const auto* real = std::get_if<double*>(&place)) return takes(**real);
    return true;
  }
};

/// A row. What follows the constructor in a table names its column.
struct ArrayKey {
  std::string name; ///< in files and overrides
  Place place;
  std::string meaning;
  const char* unit = "";
  Allowed allowed;
  int vectors_line = 0; ///< its place among the lines of a case of test vectors; 0: no answer depends on it
  int plainest = 0;     ///< number, or number of the name, that a failing case is shrunk towards
  bool counts = true;   ///< as the array stands
  const char* counts_with = "";

  ArrayKey(std::string key, Place where, std::string means)
      : name(std::move(key)), place(where), meaning(std::move(means)) {}

  /// The name without its table.
  std::string word() const { return name.substr(name.find('.') + 1); }
  std::string value() const { return std::visit(ValueText(), place); }

  ArrayKey& in_unit(const char* words) { return unit = words, *this; }
  ArrayKey& allows(Allowed values) { return allowed = std::move(values), *this; }
  ArrayKey& in_vectors(int line) { return vectors_line = line, *this; }
  template <typename Value> ArrayKey& plain(Value value) { return plainest = static_cast<int>(value), *this; }
  ArrayKey& counts_only(bool now, const char* with) { return counts = now, counts_with = with, *this; }
};
using ArrayKeys = std::vector<ArrayKey>;

} // namespace hopmesh::spec
