// The keys of a file as a table of rows: what a key is called, where its value stands, what may stand there
// and when it counts. A single reader, a single writer and the pages walk such tables, whatever the file
// describes.
#pragma once

#include "rtl_model/spec/array_keys.h"
#include "sim/input/key_reader.h"

#include <functional>
#include <optional>

namespace hopmesh::input {

using Vector3 = std::array<double, 3>;

/// A number, or a word that stands for none.
struct Worded {
  const char* word;
  std::optional<double>* number;
};

/// A value of no common kind, which reads and writes itself.
struct Special {
  std::function<void(const TomlSource&, const TomlValue&)> read;
  std::function<std::string()> text;
};

/// A table of keys that a file may leave out altogether; `make` makes what they describe. `required` is the
/// key that must be inside; the words tell what was found without it, and what was expected.
struct Part {
  std::function<void()> make;
  const char *required = nullptr, *found = nullptr, *expected = nullptr;
};

/// Where the value of a key stands; nowhere (monostate) while its part is left out.
using Place = std::variant<std::monostate, bool*, int*, std::int64_t*, double*, std::string*, Vector3*,
                           std::optional<double>*, std::optional<std::string>*, std::optional<Vector3>*,
                           spec::Choice, spec::NumberFormat*, spec::Accumulator, Worded, Special, Part>;

/// The place of a member of a part.
template <typename Group, typename Value> Place in(std::optional<Group>& part, Value Group::*member) {
  return part ? Place(&((*part).*member)) : Place();
}

/// What becomes of a key that does not count.
enum class Otherwise {
  told,            ///< it may stand there; people are told that it does nothing
  refused,         ///< a mistake, and never written
  nothing_but_zero ///< any value but 0 is a mistake; never written
};

/// Whether a key counts, and beside which setting it does. `why` follows "0: " where 0 may stand there.
struct When {
  bool holds = true;
  const char* beside = "";
  Otherwise otherwise = Otherwise::told;
  const char* why = "";
};

/// A value of a key that leaves something out of what is computed: the number, what it is, how that is said.
struct LeftOut {
  double at = 0;
  const char *what = nullptr, *words = "";
};

/// A row. What follows the constructor in a table names its column.
struct Key {
  std::string name; ///< with its tables: "mesh.grid.rows"
  Place place;
  Range range = any_number; ///< of numbers; of texts, the words alone
  std::string meaning;
  const char* unit = "";
  When when;
  std::string unset, allowed; ///< on a page: default and range where the value does not say them
  LeftOut left_out;

  Key(std::string key, Place where, std::string means)
      : name(std::move(key)), place(std::move(where)), meaning(std::move(means)) {}
  Key(std::string key, Place where, const Range& values, std::string means)
      : Key(std::move(key), std::move(where), std::move(means)) {
    range = values;
  }

  Key& in_unit(const char* words) { return unit = words, *this; }
  Key& counts(const When& condition) { return when = condition, *this; }
  Key& unset_is(const char* words) { return unset = words, *this; }
  Key& allows(std::string words) { return allowed = std::move(words), *this; }
  Key& leaves_out(double at, const char* what, const char* words) {
    return left_out = {at, what, words}, *this;
  }
};
using Keys = std::vector<Key>;

/// Makes the parts that the source has a table for, and refuses those without their required key. The places
/// of their keys are there in a table made afterwards.
void make_parts(const TomlSource& source, const Keys& keys);
/// Reads what the source says of each key; what it does not name stays as it is.
void read_keys(KeyReader& reader, const Keys& keys);
/// Refuses keys beside settings with which they never go.
void refuse_beside(const TomlSource& source, const Keys& keys);

/// A line for each key that was set, by an override or to something else than in `fresh`, and does not
/// count. `fresh` has the same keys with their defaults.
std::vector<std::string> without_effect(const TomlSource& source, const Keys& keys, const Keys& fresh);

/// Such a line for one key, of a value that counts only beside something.
std::string no_effect(const TomlSource& source, const TomlValue& value, const std::string& key,
                      const std::string& beside);

/// A value as TOML; empty where there is none.
std::string value_text(const Place& place);
/// The table as a TOML file with every value that is there.
std::string toml_text(const Keys& keys);

/// Whether the value is the one that leaves something out; no vector at all counts as one of length 0.
bool is_left_out(const Key& key);

} // namespace hopmesh::input
