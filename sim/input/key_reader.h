// Typed reading of known keys: each read leaves its target alone where the key is absent, and refuses what is
// no such value; at the end, keys that nobody read are unknown ones.
#pragma once

#include "sim/input/toml_source.h"

#include <array>
#include <cmath>
#include <set>

namespace hopmesh::input {

/// An interval of numbers and the words for it.
struct Range {
  double low, high;
  const char* words;
};

// Bounds far outside any mesh, but near enough that products of a few numbers stay finite in double.
inline constexpr Range any_number{-HUGE_VAL, HUGE_VAL, "a number"};
inline constexpr Range any_real{-1e15, 1e15, "a number from -1e15 to 1e15"};
inline constexpr Range above_zero{1e-15, 1e15, "a number above 0 (1e-15 to 1e15)"};
inline constexpr Range from_zero{0, 1e15, "a number from 0 to 1e15"};
inline constexpr Range zero_to_one{0, 1, "a number from 0 to 1"};

class KeyReader {
 public:
  explicit KeyReader(const TomlSource& source) : source_(source) {}

  /// The value of a key, which is known from now on; nullptr where it is absent.
  const TomlValue* value(const std::string& key);

  /// Each returns whether the key is there.
  bool real(const std::string& key, double& target, const Range& range);
  bool integer(const std::string& key, std::int64_t& target, std::int64_t low, std::int64_t high);
  bool integer(const std::string& key, int& target, int low, int high);
  bool text(const std::string& key, std::string& target, const std::string& expected);
  bool flag(const std::string& key, bool& target);
  bool vector(const std::string& key, std::array<double, 3>& target);
  /// Any of a few names.
  bool choice(const std::string& key, std::string& target, const std::vector<std::string>& names);

  /// The number in a value that may be written as an integer.
  double number(const TomlValue& value, const std::string& key, const Range& range) const;

  /// Refuses the first key of the source that was never asked for.
  void refuse_unknown() const;

 private:
  bool known_table(const std::string& key) const;
  std::string siblings(const std::string& key) const;
  InputError unknown(const std::string& key, const TomlValue& value) const;

  const TomlSource& source_;
  std::set<std::string> known_;
};

/// "a, b or c", each in quotes.
std::string one_of(const std::vector<std::string>& names);

} // namespace hopmesh::input
