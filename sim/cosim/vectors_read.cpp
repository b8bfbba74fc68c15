// Text -> jobs and answers. Every line has one place; what stands there instead is told with its number.
#include "sim/cosim/vectors.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/input/input_error.h"
#include "sim/input/number.h"
#include "sim/input/whole_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>

namespace hopmesh::cosim {

using input::in_quotes;

VectorReader::VectorReader(const std::string& path, spec::ArrayTable table)
    : path_(path), table_(table), file_(path, std::ios::binary) {
  const std::string kind = "a file of test vectors";
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw input::input_error(path, 0, "", "a directory", kind);
  if (!file_)
    throw input::input_error(path, 0, "", errno == ENOENT ? "no such file" : std::strerror(errno), kind);
  std::string head(std::strlen(vectors_header), '\0'); // before a line that may be no line at all
  file_.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file_.gcount()));
  line_ = 1;
  if (head.empty()) throw input::input_error(path, 0, "", "an empty file", kind);
  std::string rest;
  if (head == vectors_header) std::getline(file_, rest);
  if (!rest.empty() && rest.back() == '\r') rest.pop_back();
  if (head != vectors_header || !rest.empty())
    fail(in_quotes((head + rest).substr(0, (head + rest).find_first_of("\r\n"))),
         std::string(vectors_header));
}

void VectorReader::fail(const std::string& found, const std::string& expected,
                        const std::string& nearest) const {
  throw input::input_error(path_, line_, "", found, expected, nearest);
}

// The next line that says something; false at the end.
bool VectorReader::read_line() {
  while (std::getline(file_, text_)) {
    line_ += 1;
    if (!text_.empty() && text_.back() == '\r') text_.pop_back();
    const auto first = text_.find_first_not_of(" \t");
    if (first != std::string::npos && text_[first] != '#') return true;
  }
  return false;
}

// The words behind `key`, which must begin the next line.
VectorReader::Words VectorReader::expect(const std::string& key, const std::string& shape) {
  if (!read_line()) fail("the end of the file", shape);
  Words words = split();
  if (words[0] != key) fail(in_quotes(text_), shape, input::nearest_name(words[0], {key}));
  words.erase(words.begin());
  return words;
}

std::int64_t VectorReader::number(const std::string& word, std::int64_t least, std::int64_t most,
                                  const std::string& what) const {
  std::int64_t value = 0;
  if (!input::parse_number(word, value) || value < least || value > most)
    fail(in_quotes(word), fmt::format("{}, an integer from {} to {}", what, least, most));
  return value;
}

std::int32_t VectorReader::code(const std::string& word) const {
  return static_cast<std::int32_t>(number(word, INT32_MIN, INT32_MAX, "a raw code"));
}

bool VectorReader::next(VectorCase& a_case) {
  skip_answers();
  if (!read_line()) return false;
  const Words words = split();
  if (words[0] != "case" || words.size() < 2)
    fail(in_quotes(text_), "case NAME", input::nearest_name(words[0], {"case"}));
  a_case.name = text_.substr(text_.find(words[1], text_.find("case") + 4));
  key_lines_.clear();
  ArrayJob job;
  read_array(job.array);
  read_links(job.topology);
  check_rules(job.array, job.topology);
  const auto one = [this](const char* key, std::int64_t most) {
    const Words w = expect(key, fmt::format("{} N", key));
    if (w.size() != 1) fail(in_quotes(text_), fmt::format("{} N", key));
    return static_cast<std::uint32_t>(number(w[0], 0, most, key));
  };
  job.threshold = one("threshold", UINT32_MAX);
  job.max_sweeps = one("max_sweeps", UINT32_MAX);
  read_neurons(job);
  read_phases(job);
  if (!expect("answers", "answers").empty()) fail(in_quotes(text_), "answers");
  in_answers_ = true;
  next_sweep_ = 1, next_phase_ = 0;
  a_case.job = std::move(job);
  return true;
}

// ---- the array ----

/// The line of one key: its words go where the value stands, or are refused.
struct KeyLine {
  VectorReader& reader;
  const std::string key;

  VectorReader::Words words(const std::string& shape) const { return reader.expect(key, shape); }
  [[noreturn]] void fail(const std::string& shape, const std::string& nearest = "") const {
    reader.fail(in_quotes(reader.text_), shape, nearest);
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

  void operator()(int* at) const {
    const std::string shape = key + " N";
    const auto w = words(shape);
    if (w.size() != 1) fail(shape);
    *at = static_cast<int>(reader.number(w[0], 0, 1'000'000, key));
  }

  void operator()(spec::NumberFormat* at) const {
    read_format(key + " FORMAT, such as fixed<16,2,SC_TRN_ZERO,SC_SAT>", at);
  }

  void operator()(const spec::Accumulator& sum) const {
    *sum.exact = !read_format("accumulator exact, or accumulator FORMAT", sum.format, "exact");
  }

  /// False where the line says `none` instead.
  bool read_format(const std::string& shape, spec::NumberFormat* at, const std::string& none = "") const {
    const auto w = words(shape);
    if (!none.empty() && w == VectorReader::Words{none}) return false;
    const auto format = w.size() == 1 ? spec::parse_format(w[0]) : std::nullopt;
    if (!format) fail(shape);
    *at = *format;
    return true;
  }

  void operator()(double*) const {} // no answer depends on one
};

void VectorReader::read_array(spec::ArraySpec& a) {
  a.name = "vectors";
  for (const spec::ArrayKey& key : spec::answer_keys(table_(a))) {
    std::visit(KeyLine{*this, key.word()}, key.place);
    key_lines_.push_back({key.word(), line_});
  }
}

// A rule that the array breaks, told at the line of its key.
void VectorReader::check_rules(const spec::ArraySpec& array, const spec::Topology& topology) const {
  const auto fault = spec::validate(array, topology.most_taps(), table_);
  if (!fault) return;
  const std::string key = fault->key.substr(fault->key.find('.') + 1);
  for (const auto& [name, line] : key_lines_)
    if (name == key) throw input::input_error(path_, line, key, fault->found, fault->expected);
  fail(fault->found, fault->expected);
}

// ---- the network ----

void VectorReader::read_links(spec::Topology& t) {
  const auto one = [this](const char* key, std::int64_t least, std::int64_t most) {
    const Words w = expect(key, fmt::format("{} N", key));
    if (w.size() != 1) fail(in_quotes(text_), fmt::format("{} N", key));
    return number(w[0], least, most, key);
  };
  const std::int64_t cells = one("cells", 1, spec::most_cells);
  t.neurons_per_cell = static_cast<int>(one("neurons_per_cell", 1, 3));
  t.first_link = {0};
  std::vector<int> lines;
  for (std::int64_t c = 0; c < cells; ++c) {
    const std::string shape = fmt::format("links {} and its neighbours, ascending", c);
    const Words w = expect("links", shape);
    if (w.empty() || w[0] != std::to_string(c)) fail(in_quotes(text_), shape);
    lines.push_back(line_);
    std::int64_t least = 0;
    for (std::size_t k = 1; k < w.size(); ++k) {
      const std::int64_t other = number(w[k], least, cells - 1, "a neighbour in ascending order");
      if (other == c) fail(in_quotes(w[k]), "another cell");
      t.link_to.push_back(static_cast<std::uint32_t>(other));
      least = other + 1;
    }
    t.first_link.push_back(static_cast<std::uint32_t>(t.link_to.size()));
  }
  check_links(t, lines);
}

// Links lead both ways.
void VectorReader::check_links(const spec::Topology& t, const std::vector<int>& lines) const {
  const auto begin = t.link_to.begin();
  for (std::size_t c = 0; c < t.cells(); ++c)
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k) {
      const std::uint32_t other = t.link_to[k];
      if (std::binary_search(begin + t.first_link[other], begin + t.first_link[other + 1], c)) continue;
      throw input::input_error(path_, lines[c], "links", fmt::format("cell {} linked to {}", c, other),
                               fmt::format("{} among the neighbours of {} too", c, other));
    }
}

void VectorReader::read_neurons(ArrayJob& job) {
  const spec::Topology& t = job.topology;
  for (std::size_t i = 0; i < t.neurons(); ++i) {
    const std::size_t taps = t.taps(i / static_cast<std::size_t>(t.neurons_per_cell));
    const std::string shape = fmt::format("neuron {}, start, bias and {} weights", i, taps);
    const Words w = expect("neuron", shape);
    if (w.size() != 3 + taps) fail(fmt::format("{} words behind \"neuron\"", w.size()), shape);
    if (w[0] != std::to_string(i)) fail("neuron " + in_quotes(w[0]), shape);
    job.start.push_back(code(w[1]));
    job.bias.push_back(code(w[2]));
    for (std::size_t tap = 0; tap < taps; ++tap) job.weight.push_back(code(w[3 + tap]));
  }
}

// What the schedule says anyway; a file that says otherwise would be filled in wrongly.
void VectorReader::read_phases(const ArrayJob& job) {
  phases_ = spec::phases_of(job.topology, job.array.schedule);
  const auto count = expect("phases", "phases N");
  if (count.size() != 1 || count[0] != std::to_string(phases_.size()))
    fail(in_quotes(text_), fmt::format("phases {} by the schedule", phases_.size()));
  for (std::size_t k = 0; k < phases_.size(); ++k) {
    const auto w = expect("phase", fmt::format("phase {} and its neurons", k));
    bool same = w.size() == 1 + phases_[k].size() && w[0] == std::to_string(k);
    for (std::size_t n = 0; same && n < phases_[k].size(); ++n)
      same = w[1 + n] == std::to_string(phases_[k][n]);
    if (same) continue;
    const std::string all = fmt::format("phase {} {}", k, fmt::join(phases_[k], " "));
    fail(in_quotes(text_), (all.size() > 100 ? all.substr(0, 100) + "..." : all) + " by the schedule");
  }
}

} // namespace hopmesh::cosim
