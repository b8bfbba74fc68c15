// Lines of test vectors, of arrays and of neurons: statements of one line each, the keys of an array among
// them.
#pragma once

#include "rtl_model/spec/array_keys.h"

#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace hopmesh::cosim {

using Words = std::vector<std::string>;

/// The array's keys on which answers depend, a line each, and the exact accumulator's format in a comment.
std::string array_lines(spec::ArraySpec array, std::size_t taps, spec::ArrayTable table = spec::array_keys);

/// Reads a file line by line, however long it is; throws input::InputError with the line of a mistake.
class VectorLines {
 public:
  /// The first line must be a header; `kind`: what such a file is, in words. Behind a header that begins with
  /// "# ", other lines may begin so, too.
  VectorLines(const std::string& path, const Words& headers, const std::string& kind);

  /// The next line that says something; false at the end.
  bool read();
  const std::string& text() const { return text_; } ///< of the line at hand
  int line() const { return line_; }
  const std::string& path() const { return path_; }
  const std::string& header() const { return header_; } ///< that the file has

  Words split() const;
  /// The words behind `key`, which must begin the next line.
  Words expect(const std::string& key, const std::string& shape);
  /// The single number behind `key`.
  std::int64_t expect_number(const std::string& key, std::int64_t least, std::int64_t most);
  std::int64_t number(const std::string& word, std::int64_t least, std::int64_t most,
                      const std::string& what) const;
  [[noreturn]] void fail(const std::string& found, const std::string& expected,
                         const std::string& nearest = "") const;

  void read_array(spec::ArraySpec& array, spec::ArrayTable table);
  /// Throws at the line of the key whose rule the array breaks for rows of so many taps.
  void check_rules(const spec::ArraySpec& array, std::size_t taps, spec::ArrayTable table) const;

 private:
  void open(const std::string& kind);

  const std::string path_;
  std::ifstream file_;
  std::string header_, text_;
  std::string mark_; ///< may begin any line, and is no part of it
  int line_ = 0;
  std::vector<std::pair<std::string, int>> key_lines_;
};

} // namespace hopmesh::cosim
