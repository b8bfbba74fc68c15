// Firings as lines: of words between blanks, or of cells between commas. The table of columns rules them all.
#include "sim/cosim/firings/firing_edges.h"
#include "sim/cosim/firings/firing_files.h"
#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/input/number.h"

#include <fmt/format.h>
#include <sstream>

namespace hopmesh::cosim {

namespace {

using input::in_quotes;

constexpr std::size_t most_taps_told = 1'000'000;

/// Headings of all cells of a line.
Words headings(const NeuronShape& shape) {
  Words all;
  for (const FiringColumn& column : firing_columns())
    for (std::size_t k = 0; k < count_of(column, shape); ++k)
      all.push_back(column.count == Count::one ? column.name : fmt::format("{}_{}", column.name, k));
  return all;
}

class LinesWriter : public FiringWriter {
 public:
  LinesWriter(bool csv, const std::filesystem::path& path, const NeuronShape& shape, const FiringTask& task)
      : csv_(csv), blank_(task.blank), shape_(shape), file_(path) {
    std::istringstream head(fmt::format("{}\n{}", firings_header, shape_lines(task.name, shape)));
    for (std::string line; std::getline(head, line);) file_.write((csv ? "# " : "") + line + '\n');
    write_words("columns", headings(shape));
  }

  void add(const Firing& firing) override {
    const FiringRow row = row_of(firing, shape_);
    Words words;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const bool hidden = blank_ && firing_columns()[c].part == Part::answer;
      for (const Cell& cell : row[c])
        words.push_back(hidden || !cell      ? "?"
                        : c == edges_column_ ? edge_names(firing.edges)
                                             : std::to_string(*cell));
    }
    write_words("fire", words);
  }
  void commit() override { file_.commit(); }

 private:
  void write_words(const char* key, const Words& words) {
    file_.write(csv_ ? fmt::format("{}\n", fmt::join(words, ","))
                     : fmt::format("{} {}\n", key, fmt::join(words, " ")));
  }

  const bool csv_, blank_;
  const NeuronShape& shape_;
  const std::size_t edges_column_ = column_named("edges");
  files::OutputFile file_;
};

class LinesReader : public FiringReader {
 public:
  explicit LinesReader(const std::string& path)
      : lines_(path, {firings_header, fmt::format("# {}", firings_header)}, "a file of firings"),
        csv_(lines_.header() != firings_header), shape_(read_shape(lines_)) {
    const Words expected = headings(shape_);
    const std::string shape = fmt::format("the {} columns of rows of {} taps", expected.size(), shape_.taps);
    if (!lines_.read()) lines_.fail("the end of the file", shape);
    const Words found = words("columns");
    for (std::size_t k = 0; k < std::max(found.size(), expected.size()); ++k)
      if (k >= found.size() || k >= expected.size() || found[k] != expected[k])
        lines_.fail(k < found.size() ? in_quotes(found[k]) : "the end of the line",
                    k < expected.size() ? "column " + expected[k] : "the end of the line");
  }

  bool next(FiringRow& row) override {
    if (!lines_.read()) return false;
    const Words w = words("fire");
    row.clear();
    std::size_t at = 0;
    for (const FiringColumn& column : firing_columns()) {
      row.emplace_back();
      for (std::size_t k = 0; k < count_of(column, shape_); ++k, ++at) {
        if (at >= w.size()) lines_.fail(fmt::format("{} cells", w.size()), column.name);
        row.back().push_back(cell(column, w[at]));
      }
    }
    if (at < w.size()) lines_.fail(fmt::format("{} cells", w.size()), fmt::format("{} cells", at));
    return true;
  }
  std::string place() const override { return fmt::format("{}:{}", lines_.path(), lines_.line()); }
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const override {
    lines_.fail(found, expected);
  }
  const NeuronShape& shape() const override { return shape_; }

 private:
  /// The cells of the line at hand, behind its key.
  Words words(const std::string& key) const {
    std::istringstream in(lines_.text());
    Words all;
    if (csv_)
      for (std::string word; std::getline(in, word, ',');) all.push_back(word);
    else
      all = lines_.split();
    if (csv_) return all;
    if (all[0] != key)
      lines_.fail(in_quotes(lines_.text()), key + " and its cells", input::nearest_name(all[0], {key}));
    all.erase(all.begin());
    return all;
  }

  Cell cell(const FiringColumn& column, const std::string& word) const {
    if (word == "?") return std::nullopt;
    if (column.name == std::string("edges")) {
      const auto edges = edges_named(word);
      if (!edges) lines_.fail(in_quotes(word), "names of edges, or -");
      return *edges;
    }
    return lines_.number(word, INT64_MIN, INT64_MAX, column.name);
  }

  VectorLines lines_;
  const bool csv_;
  const NeuronShape shape_;
};

} // namespace

std::string shape_lines(const std::string& name, const NeuronShape& shape) {
  return fmt::format("case {}\n{}taps {}\n", name, array_lines(shape.array, shape.taps), shape.taps);
}

NeuronShape read_shape(VectorLines& lines) {
  if (lines.expect("case", "case NAME").empty()) lines.fail(in_quotes(lines.text()), "case NAME");
  spec::ArraySpec array;
  lines.read_array(array, spec::array_keys);
  const auto taps = static_cast<std::size_t>(lines.expect_number("taps", 1, most_taps_told));
  lines.check_rules(array, taps, spec::array_keys);
  return {array, taps};
}

std::unique_ptr<FiringWriter> make_lines_writer(bool csv, const std::filesystem::path& path,
                                                const NeuronShape& shape, const FiringTask& task) {
  return std::make_unique<LinesWriter>(csv, path, shape, task);
}

std::unique_ptr<FiringReader> open_firing_lines(const std::string& path) {
  return std::make_unique<LinesReader>(path);
}

std::unique_ptr<FiringWriter> make_firing_writer(FiringFormat format, const std::filesystem::path& path,
                                                 const NeuronShape& shape, const FiringTask& task) {
  if (format == FiringFormat::memh) return make_memories_writer(path, shape, task);
  return make_lines_writer(format == FiringFormat::csv, path, shape, task);
}

std::unique_ptr<FiringReader> open_firings(const std::string& path) {
  return std::filesystem::is_directory(path) ? open_firing_memories(path) : open_firing_lines(path);
}

} // namespace hopmesh::cosim
