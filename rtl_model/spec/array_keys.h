// Every key of an array as a row: its name in files, where its value stands, what may stand there and when it
// counts. Readers, writers, test vectors, `info`, random and shrunk arrays, and the page walk these rows.
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
using Place = std::variant<int*, double*, Choice, NumberFormat*, Accumulator>;

/// The value that stands there, as one word.
struct ValueText {
  std::string operator()(const int* x) const { return std::to_string(*x); }
  std::string operator()(const double* x) const { return std::to_string(*x); }
  std::string operator()(const Choice& choice) const { return std::string(choice.name()); }
  std::string operator()(const NumberFormat* format) const { return format->text(); }
  std::string operator()(const Accumulator& sum) const { return *sum.exact ? "exact" : sum.format->text(); }
};

/// Which numbers can be built, and the words for them: all from `least` to `most`, or only those of a list.
/// Of formats, words alone: their rules reach across keys (array_rules.h).
struct Allowed {
  std::string words;
  double least = 0, most = 0;
  std::vector<int> only = {};

  bool takes(double x) const {
    if (!only.empty()) return std::find(only.begin(), only.end(), x) != only.end();
    return x >= least && x <= most;
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

namespace detail {

inline Allowed from_to(int least, int most) {
  return {std::to_string(least) + " to " + std::to_string(most), double(least), double(most)};
}

inline Allowed bits(int most, int least_integer_bits, const char* more = "") {
  return {"4 to " + std::to_string(most) + " bits, " + std::to_string(least_integer_bits) +
          " or more before the point" + more};
}

} // namespace detail

// The rows below are in the order of array files.

inline ArrayKeys structure_keys(ArraySpec& a) {
  const bool modified = a.output == Output::modified;
  const char* const with_modified = "array.output = \"modified\"";
  const char* const with_reciprocal = modified ? "array.normaliser = \"reciprocal\"" : with_modified;
  return {
      ArrayKey("array.schedule", choice(a.schedule, schedule_names),
               "who fires together: neurons of a colour, one after the other, all at once")
          .in_vectors(1)
          .plain(Schedule::sequential),
      ArrayKey("array.lanes", &a.lanes, "multipliers a neuron: inputs taken a cycle")
          .allows(detail::from_to(1, 64))
          .in_vectors(5)
          .plain(1),
      ArrayKey("array.output", choice(a.output, output_names), "V moves by R · s / N; or V is the sign of s")
          .in_vectors(2)
          .plain(Output::modified),
      ArrayKey("array.normaliser", choice(a.normaliser, normaliser_names),
               "how u = s / N is made; not looked at beside binary outputs")
          .counts_only(modified, with_modified)
          .in_vectors(3)
          .plain(Normaliser::prescaled),
      ArrayKey("array.reciprocal_bits", &a.reciprocal_bits, "width of the truncated reciprocal")
          .in_unit("bits")
          .allows(detail::from_to(4, 32))
          .counts_only(has_reciprocal(a), with_reciprocal)
          .in_vectors(4)
          .plain(18),
      ArrayKey("array.bus_bits", &a.bus_bits, "data width of the host bus")
          .in_unit("bits")
          .allows({"32, 64 or 128", 32, 128, {32, 64, 128}})
          .in_vectors(6)
          .plain(32),
      ArrayKey("array.clock_mhz", &a.clock_mhz, "only for times in seconds: changes neither bits nor cycles")
          .in_unit("MHz")
          .allows({"above 0, at most 10000", 1e-300, 10000}),
  };
}

inline ArrayKeys format_keys(ArraySpec& a) {
  Formats& f = a.formats;
  return {
      ArrayKey("formats.weight", &f.weight, "a weight as the host writes it")
          .allows(detail::bits(32, 1))
          .in_vectors(7),
      ArrayKey("formats.bias", &f.bias, "a bias as the host writes it")
          .allows(detail::bits(32, 1))
          .in_vectors(8),
      ArrayKey("formats.accumulator", Accumulator{&a.exact_accumulator, &f.accumulator},
               "the register of s; `\"exact\"`: as wide as the longest row needs")
          .allows({"`\"exact\"`, or 4 to 62 bits, no finer than a product"})
          .in_vectors(9),
      ArrayKey("formats.drive", &f.drive, "u").allows(detail::bits(32, 2)).in_vectors(10),
      ArrayKey("formats.state", &f.state, "V in the output stage").allows(detail::bits(32, 2)).in_vectors(11),
      ArrayKey("formats.link", &f.link, "V as neighbours see it")
          .allows(detail::bits(32, 2, ", no finer than the state"))
          .in_vectors(12),
  };
}

inline ArrayKeys array_keys(ArraySpec& a) {
  ArrayKeys all = structure_keys(a);
  for (const ArrayKey& key : format_keys(a)) all.push_back(key);
  return all;
}

/// The rows on which answers depend, in the order of test vectors.
inline ArrayKeys answer_keys(const ArrayKeys& all) {
  ArrayKeys some;
  std::copy_if(all.begin(), all.end(), std::back_inserter(some),
               [](const ArrayKey& key) { return key.vectors_line > 0; });
  std::sort(some.begin(), some.end(),
            [](const ArrayKey& a, const ArrayKey& b) { return a.vectors_line < b.vectors_line; });
  return some;
}

/// The table of an array. Where a walker takes one, a caller may give it rows of its own beside these.
using ArrayTable = ArrayKeys (*)(ArraySpec&);

} // namespace hopmesh::spec
