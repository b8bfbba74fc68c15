#include "sim/cosim/vector_lines.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/input/input_error.h"
#include "sim/input/number.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace hopmesh::cosim {

using input::in_quotes;

std::string array_lines(spec::ArraySpec array, std::size_t taps, spec::ArrayTable table) {
  std::string text;
  for (const spec::ArrayKey& key : spec::answer_keys(table(array))) {
    const bool exact = std::holds_alternative<spec::Accumulator>(key.place) && array.exact_accumulator;
    if (exact)
      text += fmt::format("# the exact accumulator is {}\n", spec::accumulator_format(array, taps).text());
    text += fmt::format("{} {}\n", key.word(), key.value());
  }
  return text;
}

void VectorLines::open(const std::string& kind) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored))
    throw input::input_error(path_, 0, "", "a directory", kind);
  file_.open(path_, std::ios::binary);
  if (!file_)
    throw input::input_error(path_, 0, "", errno == ENOENT ? "no such file" : std::strerror(errno), kind);
}

VectorLines::VectorLines(const std::string& path, const Words& headers, const std::string& kind)
    : path_(path) {
  open(kind);
  std::size_t longest = 0;
  for (const std::string& header : headers) longest = std::max(longest, header.size());
  line_ = 1;
  int c = 0; // no more than a header is long, before a line that may be no line at all
  while (header_.size() < longest && (c = file_.get()) != EOF && c != '\n') header_ += static_cast<char>(c);
  if (header_.empty() && c == EOF) throw input::input_error(path, 0, "", "an empty file", kind);
  const auto known = [&] { return std::find(headers.begin(), headers.end(), header_) != headers.end(); };
  std::string rest;
  if (c != '\n' && known()) std::getline(file_, rest);
  header_ += rest;
  if (!header_.empty() && header_.back() == '\r') header_.pop_back();
  if (!known()) fail(in_quotes(header_), headers.front());
  if (header_.rfind("# ", 0) == 0) mark_ = "# ";
}

void VectorLines::fail(const std::string& found, const std::string& expected,
                       const std::string& nearest) const {
  throw input::input_error(path_, line_, "", found, expected, nearest);
}

bool VectorLines::read() {
  while (std::getline(file_, text_)) {
    line_ += 1;
    if (!text_.empty() && text_.back() == '\r') text_.pop_back();
    if (!mark_.empty() && text_.rfind(mark_, 0) == 0) text_.erase(0, mark_.size());
    const auto first = text_.find_first_not_of(" \t");
    if (first != std::string::npos && text_[first] != '#') return true;
  }
  return false;
}

Words VectorLines::split() const {
  std::istringstream in(text_);
  Words words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

Words VectorLines::expect(const std::string& key, const std::string& shape) {
  if (!read()) fail("the end of the file", shape);
  Words words = split();
  if (words[0] != key) fail(in_quotes(text_), shape, input::nearest_name(words[0], {key}));
  words.erase(words.begin());
  return words;
}

std::int64_t VectorLines::expect_number(const std::string& key, std::int64_t least, std::int64_t most) {
  const std::string shape = key + " N";
  const Words w = expect(key, shape);
  if (w.size() != 1) fail(in_quotes(text_), shape);
  return number(w[0], least, most, key);
}

std::int64_t VectorLines::number(const std::string& word, std::int64_t least, std::int64_t most,
                                 const std::string& what) const {
  std::int64_t value = 0;
  if (!input::parse_number(word, value) || value < least || value > most)
    fail(in_quotes(word), fmt::format("{}, an integer from {} to {}", what, least, most));
  return value;
}

// ---- the array ----

namespace {

/// The line of one key: its words go where the value stands, or are refused.
struct KeyLine {
  VectorLines& lines;
  const std::string key;

  Words words(const std::string& shape) const { return lines.expect(key, shape); }
  [[noreturn]] void fail(const std::string& shape, const std::string& nearest = "") const {
    lines.fail(in_quotes(lines.text()), shape, nearest);
  }

  void operator()(const spec::Choice& choice) const {
    const std::vector<std::string> names(choice.names, choice.names + choice.count);
    const std::string shape = fmt::format("{} {}", key, fmt::join(names, " or "));
    const auto w = words(shape);
    const auto at = w.size() == 1 ? std::find(names.begin(), names.end(), w[0]) : names.end();
    if (at == names.end()) fail(shape, w.empty() ? "" : input::nearest_name(w[0], names));
    *choice.at = static_cast<std::uint8_t>(at - names.begin());
  }

  void operator()(bool* at) const {
    const std::string shape = key + " true or " + key + " false";
    const auto w = words(shape);
    if (w.size() != 1 || (w[0] != "true" && w[0] != "false")) fail(shape);
    *at = w[0] == "true";
  }

  void operator()(int* at) const { *at = static_cast<int>(lines.expect_number(key, 0, 1'000'000)); }

  void operator()(spec::NumberFormat* at) const {
    read_format(key + " FORMAT, such as fixed<16,2,SC_TRN_ZERO,SC_SAT>", at);
  }

  void operator()(const spec::Accumulator& sum) const {
    *sum.exact = !read_format("accumulator exact, or accumulator FORMAT", sum.format, "exact");
  }

  /// False where the line says `none` instead.
  bool read_format(const std::string& shape, spec::NumberFormat* at, const std::string& none = "") const {
    const auto w = words(shape);
    if (!none.empty() && w == Words{none}) return false;
    const auto format = w.size() == 1 ? spec::parse_format(w[0]) : std::nullopt;
    if (!format) fail(shape);
    *at = *format;
    return true;
  }

  void operator()(double*) const {} // no answer depends on one
};

} // namespace

void VectorLines::read_array(spec::ArraySpec& a, spec::ArrayTable table) {
  a.name = "vectors";
  key_lines_.clear();
  for (const spec::ArrayKey& key : spec::answer_keys(table(a))) {
    std::visit(KeyLine{*this, key.word()}, key.place);
    key_lines_.push_back({key.word(), line_});
  }
}

void VectorLines::check_rules(const spec::ArraySpec& array, std::size_t taps, spec::ArrayTable table) const {
  const auto fault = spec::validate(array, taps, table);
  if (!fault) return;
  const std::string key = fault->key.substr(fault->key.find('.') + 1);
  for (const auto& [name, line] : key_lines_)
    if (name == key) throw input::input_error(path_, line, key, fault->found, fault->expected);
  fail(fault->found, fault->expected);
}

} // namespace hopmesh::cosim
