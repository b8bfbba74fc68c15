// Firings as a folder of memories, a file a column, and what a bench includes to read them.
#include "sim/cosim/firings/firing_files.h"
#include "sim/cosim/firings/memory_image.h"
#include "sim/cosim/firings/memory_layout.h"
#include "sim/files/output_file.h"
#include "sim/input/input_error.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

std::string file_of(const FiringColumn& column) {
  return fmt::format("{}.memh", column.name);
}

class MemoriesWriter : public FiringWriter {
 public:
  MemoriesWriter(const std::filesystem::path& folder, const NeuronShape& shape, const FiringTask& task)
      : folder_(folder), shape_(shape), task_(task) {
    files::check_writable(folder, 1 << 20);
    for (const FiringColumn& column : firing_columns()) {
      if (!is_written(column)) {
        refuse_old(folder / file_of(column));
        continue;
      }
      images_.emplace_back(folder / file_of(column));
    }
  }

  void add(const Firing& firing) override {
    const FiringRow row = row_of(firing, shape_);
    auto image = images_.begin();
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (!is_written(firing_columns()[c])) continue;
      for (const Cell& cell : row[c])
        image->write(memory_word(cell.value_or(0), firing_columns()[c].bits(shape_)) + '\n');
      ++image;
    }
    count_ += 1;
  }

  // What tells of the memories comes last.
  void commit() override {
    for (files::OutputFile& image : images_) image.commit();
    files::write_file(folder_ / "neuron_layout.vh", layout_text(shape_, task_.name, count_));
    files::write_file(folder_ / "neuron_memories.vh", memories_text(task_.blank));
    files::write_file(folder_ / "README.md", folder_page(shape_, task_, count_));
    files::write_file(folder_ / firings_list, fmt::format("{}\n{}firings {}\n", firings_header,
                                                          shape_lines(task_.name, shape_), count_));
  }

 private:
  bool is_written(const FiringColumn& column) const { return !task_.blank || column.part != Part::answer; }
  static void refuse_old(const std::filesystem::path& answers) {
    if (std::filesystem::exists(answers))
      throw input::input_error(answers.string(), 0, "--blank", "answers of before",
                               "a folder without them: a core fills them in");
  }

  const std::filesystem::path folder_;
  const NeuronShape& shape_;
  const FiringTask task_;
  std::vector<files::OutputFile> images_; ///< of the columns that are written
  std::size_t count_ = 0;
};

class MemoriesReader : public FiringReader {
 public:
  explicit MemoriesReader(const std::string& folder)
      : folder_(folder), lines_((folder_ / firings_list).string(), {firings_header}, "a folder of firings"),
        shape_(read_shape(lines_)),
        count_(static_cast<std::size_t>(lines_.expect_number("firings", 0, std::int64_t{1} << 32))) {
    for (const FiringColumn& column : firing_columns()) {
      const auto path = folder_ / file_of(column);
      const bool optional = column.part == Part::answer && !std::filesystem::exists(path);
      const std::size_t cells = count_ * count_of(column, shape_);
      memories_.push_back(optional ? std::vector<Cell>(cells)
                                   : read_memory(path.string(), cells, column.bits(shape_), column.negative));
    }
  }

  bool next(FiringRow& row) override {
    if (at_ == count_) return false;
    row.clear();
    for (std::size_t c = 0; c < memories_.size(); ++c) {
      const std::size_t n = count_of(firing_columns()[c], shape_);
      const auto first = memories_[c].begin() + static_cast<std::ptrdiff_t>(at_ * n);
      row.emplace_back(first, first + static_cast<std::ptrdiff_t>(n));
    }
    at_ += 1;
    return true;
  }
  std::string place() const override { return fmt::format("{}: line {}", folder_.string(), at_ - 1); }
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const override {
    throw input::input_error(folder_.string(), 0, fmt::format("line {}", at_ - 1), found, expected);
  }
  const NeuronShape& shape() const override { return shape_; }

 private:
  const std::filesystem::path folder_;
  VectorLines lines_;
  const NeuronShape shape_;
  const std::size_t count_;
  std::vector<std::vector<Cell>> memories_; ///< of each column
  std::size_t at_ = 0;
};

} // namespace

std::unique_ptr<FiringWriter> make_memories_writer(const std::filesystem::path& folder,
                                                   const NeuronShape& shape, const FiringTask& task) {
  return std::make_unique<MemoriesWriter>(folder, shape, task);
}

std::unique_ptr<FiringReader> open_firing_memories(const std::string& folder) {
  return std::make_unique<MemoriesReader>(folder);
}

} // namespace hopmesh::cosim
