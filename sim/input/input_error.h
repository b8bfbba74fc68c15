// Bad input, told in one line: where it stands, what was found, what was expected, the nearest valid name.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace hopmesh::input {

/// Thrown for every mistake in scenes, arrays, mesh files and overrides; the program prints what() and exits
/// with 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "file:line: key: found X, expected Y (did you mean Z?)"; line 0 and empty parts are left out.
InputError input_error(const std::string& file, int line, const std::string& key, const std::string& found,
                       const std::string& expected, const std::string& nearest = "");

/// The valid name closest to `name` by edit distance, or "" if none is close enough to be a typing mistake.
std::string nearest_name(const std::string& name, const std::vector<std::string>& valid);

/// A message with nothing in it that breaks a line or is no UTF-8, whatever file it quotes: control
/// characters become \xNN, and so does everything beyond ASCII where some of it is no UTF-8.
std::string as_a_line(const std::string& text);

/// A piece of somebody's file as a message may show it: in quotes, printable, cut where it gets long.
std::string in_quotes(std::string_view text);

} // namespace hopmesh::input
