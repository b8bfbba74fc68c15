#include "sim/study/study_folder.h"

#include "sim/files/csv_table.h"
#include "sim/input/whole_file.h"
#include "sim/study/result_table.h"

#include <fmt/format.h>

namespace hopmesh::study {

namespace {

namespace fs = std::filesystem;

} // namespace

StudyFolder::StudyFolder(const Study& study, fs::path folder, std::uint64_t hash, bool alone)
    : study_(study), folder_(std::move(folder)) {
  files::check_writable(folder_, 0);
  if (alone) lock_.emplace(folder_);
  const fs::path mark = folder_ / "study.hash";
  const std::string text = fmt::format("{:016x}\n", hash);
  if (!fs::exists(mark)) {
    files::check_writable(folder_ / "points", 0);
    files::write_file(folder_ / "study.toml", study.text);
    files::write_file(mark, text);
  } else if (input::read_whole_file(mark.string(), "a study's hash", 1000) != text) {
    throw input::input_error(folder_.string(), 0, "--out",
                             "the results of another study, or of this one before a change",
                             "a folder of its own, or the study as it was (study.toml there)");
  }
}

fs::path StudyFolder::file_of(std::size_t number) const {
  return folder_ / "points" / fmt::format("{}.csv", number);
}

bool StudyFolder::has(std::size_t number) const {
  return fs::exists(file_of(number));
}

std::vector<std::size_t> StudyFolder::missing() const {
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < study_.combinations(); ++n)
    if (!has(n)) numbers.push_back(n);
  return numbers;
}

void StudyFolder::keep(const Point& point, const PointRow& row) const {
  files::CsvWriter table(file_of(point.number), result_header(study_));
  write_result(table, study_, point, row);
  table.commit();
}

std::map<std::string, std::size_t> StudyFolder::collect() const {
  std::map<std::string, std::size_t> count;
  const auto columns = result_header(study_);
  files::CsvWriter all(folder_ / "results.csv", columns);
  for (std::size_t n = 0; n < study_.combinations(); ++n) {
    const files::CsvTable one = files::read_csv(file_of(n));
    if (one.header != columns || one.rows.size() != 1)
      throw input::input_error(file_of(n).string(), 1, "", "no row of this study", "a point's row");
    for (const std::string& text : one.rows[0]) all.cell(text);
    all.end_row();
    ++count[one.text(0, heading_of(&PointRow::outcome))];
  }
  all.commit();
  return count;
}

} // namespace hopmesh::study
