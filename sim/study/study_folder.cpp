#include "sim/study/study_folder.h"

#include "sim/study/result_table.h"

#include <fmt/format.h>

namespace hopmesh::study {

StudyFolder::StudyFolder(const Study& study, const std::filesystem::path& folder, std::uint64_t hash,
                         bool alone)
    : study_(study),
      safe_(folder, "points",
            {"study.hash", hash, "the results of another study, or of this one before a change",
             "a folder of its own, or the study as it was (study.toml there)"},
            alone) {
  const std::filesystem::path text = folder / "study.toml";
  if (!std::filesystem::exists(text)) files::write_file(text, study.text);
}

std::vector<std::size_t> StudyFolder::missing() const {
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < study_.combinations(); ++n)
    if (!has(n)) numbers.push_back(n);
  return numbers;
}

void StudyFolder::save(const Point& point, const PointRow& row) const {
  files::CsvWriter table(safe_.file(std::to_string(point.number)), result_header(study_));
  write_result(table, study_, point, row);
  table.commit();
}

std::map<std::string, std::size_t> StudyFolder::collect() const {
  std::map<std::string, std::size_t> count;
  const auto columns = result_header(study_);
  files::CsvWriter all(path() / "results.csv", columns);
  for (std::size_t n = 0; n < study_.combinations(); ++n) {
    const files::CsvTable one = safe_.row(std::to_string(n), columns);
    for (const std::string& text : one.rows[0]) all.cell(text);
    all.end_row();
    ++count[one.text(0, heading_of(&PointRow::outcome))];
  }
  all.commit();
  return count;
}

} // namespace hopmesh::study
